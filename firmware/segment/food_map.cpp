#include "firmware/segment/food_map.hpp"

#include <cmath>
#include <limits>

namespace traygauge {

void FoodMap::on_place(const Vec2& pixel, int side_px, const FoodSigns& /*signs*/, double log_odds) {
  const double reach_px = 0.5 * (side_px - 1);
  const cv::Rect square(cvRound(pixel.x() - reach_px), cvRound(pixel.y() - reach_px), side_px, side_px);
  places_[view_].push_back({square, 1.0 / (1.0 + std::exp(-log_odds))});
}

cv::Mat FoodMap::probabilities(std::size_t view, PictureSize size) const {
  cv::Mat map(size.height, size.width, CV_32F, std::numeric_limits<float>::quiet_NaN());
  for (const Place& place : places_[view])
    map(place.square & cv::Rect({}, map.size())).setTo(place.probability);
  return map;
}

}  // namespace traygauge
