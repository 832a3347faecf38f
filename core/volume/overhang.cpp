#include "core/volume/overhang.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

double steepest_tilt_tangent(std::span<const SurfaceGrid> views, const InnerSurface& dish) {
  double tangent = 0.0;
  for (const SurfaceGrid& view : views) {
    const double run = (view.camera_mm.head<2>() - dish.place.centre_mm).norm();
    const double rise = view.camera_mm.z() - dish.profile.bottom_height_mm();
    if (rise > 0.0) tangent = std::max(tangent, run / rise);
  }
  return tangent;
}

bool is_undercut(const HeightMap& map, int x, int y) {
  const HeightCell& cell = map.cells.at(x, y);
  return cell.kind == CellKind::surface && cell.below_label != 0;
}

// Undercut area without the item's outermost cells, where a wall's foot may lie on either side.
std::array<double, 256> undercut_areas(const HeightMap& map) {
  std::array<double, 256> areas{};
  const double cell_mm2 = map.cell_mm * map.cell_mm;
  for (int y = 1; y + 1 < map.cells.height; ++y) {
    for (int x = 1; x + 1 < map.cells.width; ++x) {
      const std::uint8_t label = map.cells.at(x, y).label;
      if (!is_item(label) || !is_undercut(map, x, y)) continue;
      if (map.cells.at(x - 1, y).label != label || map.cells.at(x + 1, y).label != label ||
          map.cells.at(x, y - 1).label != label || map.cells.at(x, y + 1).label != label) {
        continue;
      }
      areas[label] += cell_mm2;
    }
  }
  return areas;
}

double overhang_probability(double undercut_mm2, double of_ball_mm2, const OverhangParams& params) {
  const double low_mm2 = std::max(params.wall_undercut_fraction * of_ball_mm2, params.min_undercut_mm2);
  const double high_mm2 = params.fruit_undercut_fraction * of_ball_mm2;
  if (undercut_mm2 <= low_mm2) return 0.0;
  return undercut_mm2 >= high_mm2 ? 1.0 : (undercut_mm2 - low_mm2) / (high_mm2 - low_mm2);
}

}  // namespace

void close_overhangs(std::span<const SurfaceGrid> views, const HeightMap& map, const InnerSurface& dish,
                     const LabelSet& round, const OverhangParams& params, std::span<HeightVolume> items) {
  const double tangent = steepest_tilt_tangent(views, dish);
  const std::array<double, 256> undercut = undercut_areas(map);
  for (std::size_t label = kFirstItemLabel; label <= kLastItemLabel; ++label) {
    HeightVolume& item = items[label];
    item.undercut_mm2 = undercut[label];
    const double of_ball = std::sqrt(item.area_mm2) * 0.5 * item.max_height_mm * tangent;
    if (!(item.area_mm2 > 0.0)) continue;
    const double probability = round.contains(static_cast<std::uint8_t>(label))
                                   ? 1.0
                                   : overhang_probability(item.undercut_mm2, of_ball, params);
    const double air_ml = item.column_volume_ml * (1.0 - 1.0 / params.column_over_closed);
    item.volume_ml = item.column_volume_ml - probability * air_ml;
    item.closing_sigma_ml = std::sqrt(probability * (1.0 - probability)) * air_ml;
  }
}

}  // namespace traygauge
