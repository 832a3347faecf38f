#include "core/volume/contact_level.hpp"

#include <algorithm>
#include <cmath>

#include "core/labels/label_regions.hpp"
#include "core/stereo/dish_projection.hpp"
#include "core/volume/densest_window.hpp"

namespace traygauge {
namespace {

// Calls `action` with the height of the dish behind every place where the outline passes between two samples.
template <class Action>
void for_each_contact(const SurfaceGrid& view, const InnerSurface& dish, std::uint8_t label,
                      Action&& action) {
  const auto run_at = [&](int x, int y) -> Vec2 {
    const SurfacePoint& point = view.points.at(x, y);
    const Vec3 sight = Vec3(point.x_mm, point.y_mm, point.z_mm) - view.camera_mm;
    return sight.head<2>() / -sight.z();
  };
  const auto visit = [&](int x, int y, int to_x, int to_y) {
    if (to_x >= view.labels.width || to_y >= view.labels.height) return;
    const std::uint8_t a = view.labels.at(x, y);
    const std::uint8_t b = view.labels.at(to_x, to_y);
    if (!((a == label && b == kDishLabel) || (a == kDishLabel && b == label))) return;
    action(settled_height_mm(dish, view.camera_mm, 0.5 * (run_at(x, y) + run_at(to_x, to_y))));
  };
  for (int y = 0; y < view.labels.height; ++y) {
    for (int x = 0; x < view.labels.width; ++x) {
      if (view.labels.at(x, y) == 0) continue;
      visit(x, y, x + 1, y);
      visit(x, y, x, y + 1);
    }
  }
}

}  // namespace

ContactLevel find_contact_level(std::span<const SurfaceGrid> views, const InnerSurface& dish,
                                std::uint8_t label, double tolerance_mm, std::span<std::uint32_t> histogram) {
  std::fill(histogram.begin(), histogram.end(), 0U);
  const double lowest_mm = dish.profile.bottom_height_mm();
  const auto last = static_cast<double>(histogram.size()) - 1.0;
  ContactLevel level;
  for (const SurfaceGrid& view : views) {
    for_each_contact(view, dish, label, [&](double height_mm) {
      const double bin = std::clamp((height_mm - lowest_mm) / kContactBinMm, 0.0, last);
      ++histogram[static_cast<std::size_t>(bin)];
      ++level.samples;
    });
  }
  const auto window =
      static_cast<std::size_t>(std::clamp(2.0 * tolerance_mm / kContactBinMm, 1.0, 0.5 * last));
  const auto [best, most] = find_densest_window(histogram, window);
  if (most == 0) return level;
  double sum = 0.0;
  for (std::size_t bin = best + 1 - std::min(window, best + 1); bin <= best; ++bin)
    sum += histogram[bin] * (static_cast<double>(bin) + 0.5);
  level.level_mm = lowest_mm + kContactBinMm * sum / most;
  level.share = static_cast<double>(most) / level.samples;
  return level;
}

}  // namespace traygauge
