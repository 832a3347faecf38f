// How a view's lines of sight lean out over the outlines of a rectified row.
#pragma once

#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/stereo/occlusion_filling.hpp"
#include "core/stereo/plane_rectification.hpp"

namespace traygauge {

class RectifiedViewSlope final : public ViewSlope {
 public:
  // `labels` as view `view` of the grid shows them; both must outlive this.
  RectifiedViewSlope(const PlaneRectification& grid, ImageView<const std::uint8_t> labels, int view, int row)
      : grid_(grid), labels_(labels), view_(view), row_(row) {}

  // The normal is that of a line through the outline in the rows around.
  double at(int column, int side) const override;

 private:
  Vec2 plane_mm(int row, int column) const;
  Vec2 normal(int column, int side) const;

  const PlaneRectification& grid_;
  ImageView<const std::uint8_t> labels_;
  int view_;
  int row_;
};

}  // namespace traygauge
