#include "core/paper/surface/dish_surface.hpp"

#include <algorithm>

namespace traygauge::paper {

Status measure_rim_height(const DishInput& input, const DishParams& params, DishWorkspace& workspace,
                          double& rim_height_mm) {
  const bool over_card = params.surface == DishSurface::card_alone;
  const std::span<const Vec3> points = over_card ? input.rim_points_mm : input.card_points_mm;
  if (points.empty()) return over_card ? StatusCode::rim_not_found : StatusCode::table_not_found;
  const std::size_t count = std::min(points.size(), workspace.heights_mm.size());
  for (std::size_t i = 0; i < count; ++i) {
    workspace.heights_mm[i] =
        over_card ? input.table.height(points[i]) : input.card_thickness_mm - input.rim.height(points[i]);
  }
  const std::span<double> heights_mm = workspace.heights_mm.first(count);
  std::sort(heights_mm.begin(), heights_mm.end());
  rim_height_mm = half_sample_mode(heights_mm, params.mode);
  return StatusCode::ok;
}

Plane place_dish_bottom(const DishInput& input, const DishParams& params, double rim_height_mm,
                        double bottom_height_mm) {
  if (params.surface == DishSurface::card_alone) return input.table.raised(bottom_height_mm);
  return input.rim.raised(bottom_height_mm - rim_height_mm);
}

}  // namespace traygauge::paper
