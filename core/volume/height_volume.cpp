#include "core/volume/height_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/units.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

constexpr double kHeightBinMm = 0.5;  // kBins of them, 128 mm, are more than food is high

bool is_border(const HeightMap& map, int x, int y) {
  const std::uint8_t label = map.cells.at(x, y).label;
  return x == 0 || y == 0 || x + 1 == map.cells.width || y + 1 == map.cells.height ||
         map.cells.at(x - 1, y).label != label || map.cells.at(x + 1, y).label != label ||
         map.cells.at(x, y - 1).label != label || map.cells.at(x, y + 1).label != label;
}

// Of the walls between a cell and its neighbours to the right and below that belong to the same item.
double wall_mm2(const HeightMap& map, int x, int y, double slope) {
  const HeightCell& cell = map.cells.at(x, y);
  double area_mm2 = 0.0;
  const auto add = [&](const HeightCell& next) {
    const double rise_mm = std::abs(static_cast<double>(next.z_mm) - static_cast<double>(cell.z_mm));
    if (next.label == cell.label && rise_mm > slope * map.cell_mm) area_mm2 += rise_mm * map.cell_mm;
  };
  if (x + 1 < map.cells.width) add(map.cells.at(x + 1, y));
  if (y + 1 < map.cells.height) add(map.cells.at(x, y + 1));
  return area_mm2;
}

double max_height(std::span<const std::uint32_t> histogram, double ignored_cells) {
  double above = 0.0;
  for (std::size_t bin = histogram.size(); bin-- > 0;) {
    above += histogram[bin];
    if (above > ignored_cells) return kHeightBinMm * (static_cast<double>(bin) + 0.5);
  }
  return 0.0;
}

}  // namespace

Status integrate_height_map(const HeightMap& map, const InnerSurface& dish, const HeightVolumeParams& params,
                            HeightVolumeWorkspace& workspace) {
  constexpr std::size_t kBins = HeightVolumeWorkspace::kBins;
  std::fill(workspace.items.begin(), workspace.items.end(), HeightVolume{});
  std::fill(workspace.histograms.begin(), workspace.histograms.end(), 0U);
  std::array<int, 256> told_cells{};
  const double cell_mm2 = map.cell_mm * map.cell_mm;
  for (int y = 0; y < map.cells.height; ++y) {
    for (int x = 0; x < map.cells.width; ++x) {
      const HeightCell& cell = map.cells.at(x, y);
      if (!is_item(cell.label)) continue;
      const Vec2 place_mm = map.centre_mm(x, y);
      const double height = static_cast<double>(cell.z_mm) - dish.height_mm(place_mm);
      HeightVolume& item = workspace.items[cell.label];
      item.area_mm2 += cell_mm2;
      item.column_volume_ml += height * cell_mm2 / kMm3PerMl;
      if (cell.kind == CellKind::hidden) {
        item.hidden_volume_ml += height * cell_mm2 / kMm3PerMl;
        item.hidden_fraction += cell_mm2;
      }
      if (cell.kind == CellKind::surface && cell.below_label != 0) item.undercut_mm2 += cell_mm2;
      item.wall_mm2 += wall_mm2(map, x, y, params.wall_slope);
      if (is_border(map, x, y)) item.border_fraction += cell_mm2;
      if (cell.kind != CellKind::unseen) {
        item.centre_mm += Vec3(place_mm.x(), place_mm.y(), cell.z_mm);
        ++told_cells[cell.label];
      }
      const double bin = std::clamp(height / kHeightBinMm, 0.0, static_cast<double>(kBins - 1));
      ++workspace.histograms[cell.label * kBins + static_cast<std::size_t>(bin)];
    }
  }
  bool any = false;
  for (std::size_t label = 0; label < workspace.items.size(); ++label) {
    HeightVolume& item = workspace.items[label];
    if (!(item.area_mm2 > 0.0)) continue;
    any = true;
    item.volume_ml = item.column_volume_ml;
    item.mean_height_mm = item.column_volume_ml * kMm3PerMl / item.area_mm2;
    item.hidden_fraction /= item.area_mm2;
    item.border_fraction /= item.area_mm2;
    if (told_cells[label] > 0) item.centre_mm /= told_cells[label];
    item.max_height_mm = max_height(workspace.histograms.subspan(label * kBins, kBins),
                                    params.max_height_ignored_mm2 / cell_mm2);
  }
  return any ? StatusCode::ok : StatusCode::no_food_label;
}

}  // namespace traygauge
