#include "core/stereo/dish_projection.hpp"

#include <cmath>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr double kToleranceMm = 0.02;  // a tenth of the median height error of the best foods (figures.md)

}  // namespace

// Regula falsi with the Illinois rule (Dowell & Jarratt 1971): the line is above the dish at the crest's
// height and below it at the bottom's.
double settled_height_mm(const InnerSurface& dish, const Vec3& eye_mm, const Vec2& run_per_mm) {
  const auto above_mm = [&](double z_mm) {
    return z_mm - dish.height_mm(eye_mm.head<2>() + (eye_mm.z() - z_mm) * run_per_mm);
  };
  double low = dish.profile.bottom_height_mm();
  double below_mm = above_mm(low);
  if (!(below_mm < -kToleranceMm)) return low;
  double high = dish.profile.crest_height_mm();
  double over_mm = above_mm(high);
  if (!(over_mm > kToleranceMm)) return high;
  double found = high;
  bool was_over = false;
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    found = (low * over_mm - high * below_mm) / (over_mm - below_mm);
    const double rest_mm = above_mm(found);
    if (std::abs(rest_mm) < kToleranceMm) break;
    const bool is_over = rest_mm > 0.0;
    if (is_over) {
      high = found;
      over_mm = rest_mm;
      if (i > 0 && was_over) below_mm *= 0.5;
    } else {
      low = found;
      below_mm = rest_mm;
      if (i > 0 && !was_over) over_mm *= 0.5;
    }
    was_over = is_over;
  }
  return found;
}

void project_onto_dish(const InnerSurface& dish, const SurfaceGrid& grid, std::span<SurfacePoint> points,
                       std::span<SurfaceEvidence> evidence) {
  const Vec3& eye = grid.camera_mm;
  for (int y = 0; y < grid.labels.height; ++y) {
    const std::uint8_t* labels = grid.labels.row(y);
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.labels.width);
    for (int x = 0; x < grid.labels.width; ++x) {
      if (labels[x] != kDishLabel) continue;
      const std::size_t at = row + static_cast<std::size_t>(x);
      SurfacePoint& point = points[at];
      const Vec3 sight = Vec3(point.x_mm, point.y_mm, point.z_mm) - eye;
      if (!(sight.z() < 0.0)) continue;
      const Vec2 run = sight.head<2>() / -sight.z();
      const double z_mm = settled_height_mm(dish, eye, run);
      const Vec2 place = eye.head<2>() + (eye.z() - z_mm) * run;
      point = {static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(z_mm)};
      evidence[at] = SurfaceEvidence::both;
    }
  }
}

}  // namespace traygauge
