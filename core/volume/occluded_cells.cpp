#include "core/volume/occluded_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

using Source = HeightMapWorkspace::Source;

float distance_cells(const Source& source, int x, int y) {
  const auto dx = static_cast<float>(x - source.x);
  const auto dy = static_cast<float>(y - source.y);
  return std::sqrt(dx * dx + dy * dy);
}

// For every target cell the source whose offer is the best of those that it can be reached from over target
// cells, by two passes over the rows, each back and forth
// (P.-E. Danielsson, Euclidean distance mapping, CGIP 14, 1980): now and then a cell gets one that is a
// fraction of a cell worse. `IsTarget`: (x, y) → bool; `Offer`: (source, distance in cells) → value, larger
// is better.
template <class IsTarget, class Offer>
class SourceMap {
 public:
  SourceMap(ImageView<Source> sources, IsTarget is_target, Offer offer)
      : sources_(sources), is_target_(is_target), offer_(offer) {}

  void propagate() {
    for (int y = 0; y < sources_.height; ++y) scan_row(y, y - 1);
    for (int y = sources_.height - 1; y >= 0; --y) scan_row(y, y + 1);
  }

 private:
  void scan_row(int y, int neighbour) {
    const bool inside = neighbour >= 0 && neighbour < sources_.height;
    for (int x = 0; x < sources_.width; ++x) {
      if (!is_target_(x, y)) continue;
      if (inside) {
        if (x > 0) try_source(x, y, sources_.at(x - 1, neighbour));
        try_source(x, y, sources_.at(x, neighbour));
        if (x + 1 < sources_.width) try_source(x, y, sources_.at(x + 1, neighbour));
      }
      if (x > 0) try_source(x, y, sources_.at(x - 1, y));
    }
    for (int x = sources_.width - 2; x >= 0; --x) {
      if (is_target_(x, y)) try_source(x, y, sources_.at(x + 1, y));
    }
  }

  void try_source(int x, int y, const Source& source) {
    Source& best = sources_.at(x, y);
    if (source.x < 0 || (source.x == best.x && source.y == best.y)) return;
    if (best.x < 0 || value(source, x, y) > value(best, x, y)) best = source;
  }

  float value(const Source& source, int x, int y) const {
    return offer_(source, distance_cells(source, x, y));
  }

  ImageView<Source> sources_;
  IsTarget is_target_;
  Offer offer_;
};

// Flanks steeper than this are not seen from behind: tan(β − γ), where tan β is the line of sight's slope and
// sin γ the cosine below which a patch counts as an occlusion.
float grazing_slope(double sight_slope, const HeightMapParams& params) {
  const double sine = std::clamp(params.jump_cosine, 0.0, 0.9);
  const double tangent = sine / std::sqrt(1.0 - sine * sine);
  const double slope = (sight_slope - tangent) / (1.0 + sight_slope * tangent);
  return static_cast<float>(
      std::max(std::min(slope, params.max_flank_threshold), params.min_flank_threshold));
}

class HiddenFill {
 public:
  HiddenFill(const InnerSurface& dish, const HeightMapParams& params, double steepest_sight,
             std::span<Source> sources, HeightMap& map)
      : dish_(dish),
        params_(params),
        sources_(sources.data(), map.cells.width, map.cells.height),
        map_(map),
        cell_mm_(static_cast<float>(map.cell_mm)),
        flank_threshold_(grazing_slope(steepest_sight, params)) {}

  void fill_holes() {
    if (!has_holes()) return;
    find_sources(
        CellKind::unseen, [](const HeightCell& cell) { return cell.kind != CellKind::unseen; },
        [](const Source&, float distance) { return -distance; });
    const auto reach = static_cast<float>(params_.max_hole_mm) / cell_mm_;
    for_each_cell([&](int x, int y, HeightCell& cell) {
      const Source& source = sources_.at(x, y);
      if (cell.kind != CellKind::unseen || source.x < 0 || distance_cells(source, x, y) > reach) return;
      const HeightCell known = map_.cells.at(source.x, source.y);
      cell = known;
      if (known.kind != CellKind::surface) return;
      cell.kind = CellKind::hidden;  // under nothing: what is nearest goes on level
      cell.below_mm = known.z_mm;
      cell.below_label = known.label;
      cell.label = kDishLabel;
    });
  }

  void measure_flanks() {
    std::array<double, 256> run{};
    std::array<double, 256> drop{};
    std::array<double, 256> height{};
    std::array<double, 256> count{};
    const float threshold = flank_threshold_ * cell_mm_;
    for (int y = 0; y + 1 < map_.cells.height; ++y) {
      for (int x = 0; x + 1 < map_.cells.width; ++x) {
        const HeightCell& cell = map_.cells.at(x, y);
        const HeightCell& right = map_.cells.at(x + 1, y);
        const HeightCell& below = map_.cells.at(x, y + 1);
        if (cell.kind != CellKind::surface || right.kind != CellKind::surface ||
            below.kind != CellKind::surface) {
          continue;
        }
        height[cell.label] += static_cast<double>(cell.z_mm);
        count[cell.label] += 1.0;
        const float dx = right.z_mm - cell.z_mm;
        const float dy = below.z_mm - cell.z_mm;
        const float squared = dx * dx + dy * dy;
        if (!(squared > threshold * threshold)) continue;
        // A flank is its upper end's.
        const HeightCell& across = std::abs(dx) > std::abs(dy) ? right : below;
        const std::uint8_t label = across.z_mm > cell.z_mm ? across.label : cell.label;
        run[label] += 1.0;
        drop[label] += static_cast<double>(std::sqrt(squared));
      }
    }
    const double cell_mm = map_.cell_mm;
    const double prior_slope = 2.0 * static_cast<double>(flank_threshold_);
    for (std::size_t label = 0; label < slopes_.size(); ++label) {
      // Between cell centres even a wall takes a cell's width to fall by the item's height.
      const double mean_height =
          height[label] / std::max(count[label], 1.0) - dish_.profile.bottom_height_mm();
      const double walls = drop[label] / std::max(mean_height, cell_mm);
      const double run_mm = std::max(run[label] - walls, 0.0) * cell_mm;
      slopes_[label] = static_cast<float>(params_.hidden_steepness *
                                          (drop[label] + prior_slope * params_.prior_flank_mm2 / cell_mm) /
                                          (run_mm + params_.prior_flank_mm2 / cell_mm));
    }
  }

  void fill_hidden() {
    find_sources(
        CellKind::hidden,
        [](const HeightCell& cell) { return cell.kind == CellKind::surface && is_item(cell.label); },
        [this](const Source& source, float distance) {
          const HeightCell& known = map_.cells.at(source.x, source.y);
          return known.z_mm - slopes_[known.label] * cell_mm_ * distance;
        });
    for_each_cell([this](int x, int y, HeightCell& cell) {
      if (cell.kind == CellKind::hidden) fill(x, y, cell);
    });
  }

 private:
  template <class Action>
  void for_each_cell(Action action) {
    for (int y = 0; y < map_.cells.height; ++y) {
      for (int x = 0; x < map_.cells.width; ++x) action(x, y, map_.cells.at(x, y));
    }
  }

  // Holes are filled only in a dish with a profile; without one every inset is 0. On a flat page most holes
  // lie beside the flank of a tall body, which must not go on level: the photographed mango of 593 ml comes
  // out as 661 ml with its holes filled, as 584 ml without.
  bool has_holes() {
    bool any = false;
    for_each_cell([&](int x, int y, const HeightCell& cell) {
      if (any || cell.kind != CellKind::unseen) return;
      any = dish_.profile.inset_mm(dish_.to_dish(map_.centre_mm(x, y))) > 0.0;
    });
    return any;
  }

  template <class IsSource, class Offer>
  void find_sources(CellKind target, IsSource is_source, Offer offer) {
    for_each_cell([&](int x, int y, const HeightCell& cell) {
      sources_.at(x, y) =
          is_source(cell) ? Source{static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)} : Source{};
    });
    const auto is_target = [&](int x, int y) { return map_.cells.at(x, y).kind == target; };
    SourceMap<decltype(is_target), Offer>(sources_, is_target, offer).propagate();
  }

  void fill(int x, int y, HeightCell& cell) {
    const float bound_mm = cell.z_mm;
    const bool behind_item = is_item(cell.label);
    cell.z_mm = static_cast<float>(dish_.height_mm(map_.centre_mm(x, y)));
    cell.label = kDishLabel;
    if (is_item(cell.below_label) && cell.below_mm > cell.z_mm) {
      cell.z_mm = cell.below_mm;
      cell.label = cell.below_label;
    }
    const Source& source = sources_.at(x, y);
    if (behind_item && source.x >= 0) {
      const HeightCell& known = map_.cells.at(source.x, source.y);
      const float z_mm = continued(known, cell.z_mm, bound_mm, cell_mm_ * distance_cells(source, x, y));
      if (z_mm > cell.z_mm) {
        cell.z_mm = z_mm;
        cell.label = known.label;
      }
    }
    cell.z_mm = std::min(cell.z_mm, bound_mm);
  }

  // A parabola that leaves its edge along the bound and has fallen to the floor where the flank's mean slope
  // would have.
  float continued(const HeightCell& edge, float floor_mm, float bound_mm, float run_mm) const {
    const float drop = edge.z_mm - floor_mm;
    if (!(drop > 0.0F)) return floor_mm;
    const float slope = slopes_[edge.label];
    const float excess = slope * run_mm - std::max(edge.z_mm - bound_mm, 0.0F);
    return bound_mm - std::max(excess, 0.0F) * slope * run_mm / drop;
  }

  const InnerSurface& dish_;
  const HeightMapParams& params_;
  ImageView<Source> sources_;
  HeightMap& map_;
  float cell_mm_;
  float flank_threshold_;
  std::array<float, 256> slopes_{};  // by label
};

}  // namespace

void fill_occluded_cells(const InnerSurface& dish, const HeightMapParams& params, double steepest_sight,
                         std::span<Source> sources, HeightMap& map) {
  HiddenFill fill(dish, params, steepest_sight, sources, map);
  fill.fill_holes();
  fill.measure_flanks();
  fill.fill_hidden();
}

}  // namespace traygauge
