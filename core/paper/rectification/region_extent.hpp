// What part of the half-lines a region of a picture covers.
#pragma once

#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/paper/rectification/epipolar_view.hpp"

namespace traygauge::paper {

// The box around the pixel centres of a region (non-zero pixels); empty when there are none.
Eigen::AlignedBox2d bounding_box(ImageView<const std::uint8_t> region);

struct RegionExtent {
  double min_angle = 0.0;
  double max_angle = 0.0;  // may exceed π: a region that spans the cut of the angle stays in one piece
  bool surrounds_epipole = false;
  double min_along = 0.0;  // of EpipolarView::distance_along
  double max_along = 0.0;
};

// Measures the region, gaps within a picture row filled. It surrounds the epipole also when it comes within
// `near_px` of it.
RegionExtent measure_extent(const EpipolarView& view, ImageView<const std::uint8_t> region, double near_px);

}  // namespace traygauge::paper
