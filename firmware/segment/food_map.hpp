// How probable food is in each place of two views, as it was found.
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/segmentation/food_evidence.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

class FoodMap final : public FoodObserver {
 public:
  void on_view(std::size_t view) override { view_ = view; }
  void on_place(const Vec2& pixel, int side_px, const FoodSigns& signs, double log_odds) override;

  // 0 to 1 (float) in every pixel of a picture of this size; NaN where no dish was found.
  cv::Mat probabilities(std::size_t view, PictureSize size) const;

 private:
  struct Place {
    cv::Rect square;
    double probability;
  };

  std::size_t view_ = 0;
  std::array<std::vector<Place>, 2> places_;
};

}  // namespace traygauge
