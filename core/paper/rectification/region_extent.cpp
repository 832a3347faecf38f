#include "core/paper/rectification/region_extent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace traygauge::paper {
namespace {

// First and last pixel of the region in one picture row; false when there is none.
bool find_run(ImageView<const std::uint8_t> region, int y, int& left, int& right) {
  const std::uint8_t* row = region.row(y);
  left = 0;
  while (left < region.width && row[left] == 0) ++left;
  if (left == region.width) return false;
  right = region.width - 1;
  while (row[right] == 0) --right;
  return true;
}

// Follows the angle around a closed outline without a jump at ±π.
class AngleWalk {
 public:
  void visit(double angle) {
    if (std::isnan(first_)) {
      first_ = min_ = max_ = current_ = angle;
      return;
    }
    current_ += std::remainder(angle - current_, 2.0 * std::numbers::pi);
    min_ = std::min(min_, current_);
    max_ = std::max(max_, current_);
  }
  // Ends where it began; true when the outline went round the epipole.
  bool close() {
    const double first = first_;
    visit(first);
    return std::abs(current_ - first) > std::numbers::pi;
  }
  double min() const { return min_; }
  double max() const { return max_; }

 private:
  double first_ = std::numeric_limits<double>::quiet_NaN();
  double current_ = 0.0;
  double min_ = 0.0;
  double max_ = 0.0;
};

// Widens the extent by one run of pixels; the nearest one to the epipole may lie inside the run.
void include_run(const EpipolarView& view, const Vec2& left, const Vec2& right, double& nearest_px,
                 RegionExtent& extent) {
  const Vec3 e = view.epipole();
  Vec2 nearest = left;
  if (e.z() != 0.0) {
    nearest.x() = std::clamp(e.x() / e.z(), left.x(), right.x());
    nearest_px = std::min(nearest_px, (e.head<2>() / e.z() - nearest).norm());
  }
  for (const Vec2& pixel : {left, right, nearest}) {
    const double along = view.distance_along(pixel);
    extent.min_along = std::min(extent.min_along, along);
    extent.max_along = std::max(extent.max_along, along);
  }
}

}  // namespace

Eigen::AlignedBox2d bounding_box(ImageView<const std::uint8_t> region) {
  Eigen::AlignedBox2d box;
  int left = 0;
  int right = 0;
  for (int y = 0; y < region.height; ++y) {
    if (!find_run(region, y, left, right)) continue;
    box.extend(Vec2(left, y));
    box.extend(Vec2(right, y));
  }
  return box;
}

RegionExtent measure_extent(const EpipolarView& view, ImageView<const std::uint8_t> region, double near_px) {
  RegionExtent extent;
  extent.min_along = std::numeric_limits<double>::infinity();
  extent.max_along = -extent.min_along;
  double nearest_px = std::numeric_limits<double>::infinity();
  AngleWalk outline;
  int left = 0;
  int right = 0;
  for (int y = 0; y < region.height; ++y) {
    if (!find_run(region, y, left, right)) continue;
    outline.visit(view.angle(Vec2(left, y)));
    include_run(view, Vec2(left, y), Vec2(right, y), nearest_px, extent);
  }
  for (int y = region.height - 1; y >= 0; --y) {
    if (find_run(region, y, left, right)) outline.visit(view.angle(Vec2(right, y)));
  }
  const bool winds = outline.close();
  extent.surrounds_epipole = winds || nearest_px <= near_px;
  extent.min_angle = outline.min();
  extent.max_angle = outline.max();
  return extent;
}

}  // namespace traygauge::paper
