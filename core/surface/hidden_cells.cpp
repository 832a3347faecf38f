#include "core/surface/hidden_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/segmentation/label_regions.hpp"

namespace traygauge {
namespace {

using Source = HeightMapWorkspace::Source;

// Nearest source of every cell by two passes over the rows, each back and forth (P.-E. Danielsson, Euclidean
// distance mapping, CGIP 14, 1980): now and then a cell gets one that is a fraction of a cell further.
class NearestSource {
 public:
  NearestSource(std::span<Source> sources, int width, int height) : sources_(sources.data(), width, height) {}

  Source& at(int x, int y) { return sources_.at(x, y); }

  void propagate() {
    for (int y = 0; y < sources_.height; ++y) scan_row(y, y - 1);
    for (int y = sources_.height - 1; y >= 0; --y) scan_row(y, y + 1);
  }

  static float squared_distance(const Source& source, int x, int y) {
    if (source.x < 0) return std::numeric_limits<float>::max();
    const auto dx = static_cast<float>(x - source.x);
    const auto dy = static_cast<float>(y - source.y);
    return dx * dx + dy * dy;
  }

 private:
  void scan_row(int y, int neighbour) {
    const bool inside = neighbour >= 0 && neighbour < sources_.height;
    for (int x = 0; x < sources_.width; ++x) {
      if (inside) {
        offer(x, y, sources_.at(x, neighbour));
        if (x > 0) offer(x, y, sources_.at(x - 1, neighbour));
        if (x + 1 < sources_.width) offer(x, y, sources_.at(x + 1, neighbour));
      }
      if (x > 0) offer(x, y, sources_.at(x - 1, y));
    }
    for (int x = sources_.width - 2; x >= 0; --x) offer(x, y, sources_.at(x + 1, y));
  }

  void offer(int x, int y, const Source& source) {
    Source& best = sources_.at(x, y);
    if (source.x >= 0 && squared_distance(source, x, y) < squared_distance(best, x, y)) best = source;
  }

  ImageView<Source> sources_;
};

template <class IsSource>
void find_nearest(const HeightMap& map, NearestSource& nearest, IsSource is_source) {
  for (int y = 0; y < map.cells.height; ++y) {
    for (int x = 0; x < map.cells.width; ++x) {
      nearest.at(x, y) = is_source(map.cells.at(x, y))
                             ? Source{static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)}
                             : Source{};
    }
  }
  nearest.propagate();
}

void fill_holes(const HeightMapParams& params, NearestSource& nearest, HeightMap& map) {
  bool any = false;
  for (int y = 0; y < map.cells.height && !any; ++y) {
    const HeightCell* row = map.cells.row(y);
    any = std::any_of(row, row + map.cells.width,
                      [](const HeightCell& cell) { return cell.kind == CellKind::unseen; });
  }
  if (!any) return;
  find_nearest(map, nearest, [](const HeightCell& cell) { return cell.kind != CellKind::unseen; });
  const auto reach = static_cast<float>(params.max_hole_mm / map.cell_mm);
  for (int y = 0; y < map.cells.height; ++y) {
    for (int x = 0; x < map.cells.width; ++x) {
      HeightCell& cell = map.cells.at(x, y);
      const Source source = nearest.at(x, y);
      if (cell.kind != CellKind::unseen || NearestSource::squared_distance(source, x, y) > reach * reach) {
        continue;
      }
      const HeightCell& known = map.cells.at(source.x, source.y);
      // A seen neighbour goes on level, under no bound of its own; the dish's label tells so below.
      cell = known;
      cell.undercut = false;
      cell.weight = 0;
      if (known.kind == CellKind::surface) {
        cell.kind = CellKind::hidden;
        cell.label = is_item(known.label) ? kDishLabel : kBackgroundLabel;
      }
    }
  }
}

std::array<float, 256> flank_slopes(const HeightMapParams& params, std::span<const FlankArea> flanks) {
  std::array<float, 256> slopes{};
  for (std::size_t label = 0; label < slopes.size(); ++label) {
    slopes[label] =
        static_cast<float>((flanks[label].vertical_mm2 + params.prior_flank_slope * params.prior_flank_mm2) /
                           (flanks[label].horizontal_mm2 + params.prior_flank_mm2));
  }
  return slopes;
}

}  // namespace

void fill_hidden_cells(const PlacedDish& dish, const HeightMapParams& params,
                       std::span<const FlankArea> flanks, std::span<Source> sources, HeightMap& map) {
  NearestSource nearest(sources, map.cells.width, map.cells.height);
  fill_holes(params, nearest, map);
  find_nearest(map, nearest,
               [](const HeightCell& cell) { return cell.kind == CellKind::surface && is_item(cell.label); });
  const std::array<float, 256> slopes = flank_slopes(params, flanks);
  const auto cell_mm = static_cast<float>(map.cell_mm);
  for (int y = 0; y < map.cells.height; ++y) {
    for (int x = 0; x < map.cells.width; ++x) {
      HeightCell& cell = map.cells.at(x, y);
      if (cell.kind != CellKind::hidden) continue;
      const Source source = nearest.at(x, y);
      const auto floor_mm = static_cast<float>(dish.height_mm(map.centre_mm(x, y)));
      const float bound_mm = cell.z_mm;
      const bool behind_item = is_item(cell.label);
      const bool is_open = cell.label == kBackgroundLabel;  // a hole in the dish
      cell.z_mm = floor_mm;
      cell.label = kDishLabel;
      if (source.x < 0 || is_open) continue;
      const HeightCell& known = map.cells.at(source.x, source.y);
      const float distance_mm = cell_mm * std::sqrt(NearestSource::squared_distance(source, x, y));
      const float slope = behind_item ? slopes[known.label] : 0.0F;
      const float z_mm = std::min(known.z_mm - slope * distance_mm, bound_mm);
      if (!(z_mm > floor_mm)) continue;
      cell.z_mm = z_mm;
      cell.label = known.label;
    }
  }
}

}  // namespace traygauge
