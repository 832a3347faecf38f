#include "core/volume/level_liquid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "core/labels/label_regions.hpp"
#include "core/volume/contact_level.hpp"
#include "core/volume/densest_window.hpp"

namespace traygauge {
namespace {

constexpr int kDirections = 64;  // 5.6 degrees apart
constexpr double kLowestMm =
    -16.0;  // kBins of kContactBinMm reach from here to 112 mm, more than food is high

bool is_seen(const HeightCell& cell, std::uint8_t label) {
  return cell.kind == CellKind::surface && cell.label == label;
}

std::uint8_t largest_item(const HeightMap& map) {
  std::array<std::uint32_t, kByteValues> count{};
  for (int y = 0; y < map.cells.height; ++y) {
    for (int x = 0; x < map.cells.width; ++x) ++count[map.cells.at(x, y).label];
  }
  const auto* const largest =
      std::max_element(count.begin() + kFirstItemLabel, count.begin() + kLastItemLabel + 1);
  return *largest > 0 ? static_cast<std::uint8_t>(largest - count.begin()) : std::uint8_t{0};
}

// The window of twice the tolerance that holds most heights, then the mean of those within it, once more
// centred: solids and the near wall stay out.
double find_level(const HeightMap& map, std::uint8_t label, double tolerance_mm,
                  std::span<std::uint32_t> histogram, double& share) {
  std::fill(histogram.begin(), histogram.end(), 0U);
  const auto bins = static_cast<double>(histogram.size());
  double seen = 0.0;
  const auto for_seen = [&](auto action) {
    for (int y = 0; y < map.cells.height; ++y) {
      for (int x = 0; x < map.cells.width; ++x) {
        const HeightCell& cell = map.cells.at(x, y);
        if (is_seen(cell, label)) action(static_cast<double>(cell.z_mm));
      }
    }
  };
  for_seen([&](double z) {
    ++histogram[static_cast<std::size_t>(std::clamp((z - kLowestMm) / kContactBinMm, 0.0, bins - 1.0))];
    seen += 1.0;
  });
  const auto window =
      static_cast<std::size_t>(std::clamp(2.0 * tolerance_mm / kContactBinMm, 1.0, 0.5 * bins));
  const std::size_t best = find_densest_window(histogram, window).last;
  double level = kLowestMm + kContactBinMm * (static_cast<double>(best) + 1.0) - tolerance_mm;
  double within = 0.0;
  for (int step = 0; step < 3; ++step) {
    double sum = 0.0;
    within = 0.0;
    for_seen([&](double z) {
      if (std::abs(z - level) > tolerance_mm) return;
      sum += z - level;
      within += 1.0;
    });
    if (within > 0.0) level += sum / within;
  }
  share = seen > 0.0 ? within / seen : 0.0;
  return level;
}

// Whether the item lies at the wall's inside all round, at its level.
bool reaches_wall(const HeightMap& map, const InnerSurface& dish, std::uint8_t label, double level_mm,
                  const LevelLiquidParams& params) {
  int reached = 0;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kDirections;
    const Vec2& axis = dish.place.axis;
    const Vec2 along = std::cos(angle) * axis + std::sin(angle) * Vec2(-axis.y(), axis.x());
    // From the outside inward, past the crest, to where the wall comes down to the level.
    double radius = dish.profile.semi_axes_mm().maxCoeff();
    bool inside_crest = false;
    while (radius > 0.0) {
      const Vec2 at = dish.place.centre_mm + radius * along;
      const double inset = dish.profile.inset_mm(dish.to_dish(at));
      const double wall = dish.height_mm(at);
      inside_crest = inside_crest || (inset > 0.0 && wall > dish.profile.crest_height_mm() - 1.0);
      if (inside_crest && wall <= level_mm) break;
      radius -= 0.5 * map.cell_mm;
    }
    bool found = false;
    for (double gap = 0.0; gap <= params.max_gap_mm && !found; gap += map.cell_mm) {
      const Vec2 cell = (dish.place.centre_mm + (radius - gap) * along - map.origin_mm) / map.cell_mm;
      const int x = static_cast<int>(std::floor(cell.x() + 0.5));
      const int y = static_cast<int>(std::floor(cell.y() + 0.5));
      found = map.cells.contains(x, y) && map.cells.at(x, y).label == label;
    }
    reached += found ? 1 : 0;
  }
  return reached >= params.min_wall_fraction * kDirections;
}

// Standard deviation of the surface's heights: nothing of a liquid lies below its level, so what was matched
// there is noise. From the mean deviation, which single wrong matches move less.
double noise_mm(const HeightMap& map, const LevelLiquid& liquid) {
  double sum_mm = 0.0;
  double count = 0.0;
  for (int y = 0; y < map.cells.height; ++y) {
    for (int x = 0; x < map.cells.width; ++x) {
      const HeightCell& cell = map.cells.at(x, y);
      const double below_mm = liquid.level_mm - static_cast<double>(cell.z_mm);
      if (!is_seen(cell, liquid.label) || below_mm < 0.0) continue;
      sum_mm += below_mm;
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(0.5 * std::numbers::pi) * sum_mm / count : 0.0;
}

void make_level(const InnerSurface& dish, const LevelLiquid& liquid, const LevelLiquidParams& params,
                HeightMap& map) {
  const auto level = static_cast<float>(liquid.level_mm);
  const double solid_mm = std::max(params.min_solid_mm, params.solid_sigmas * noise_mm(map, liquid));
  const auto solid = static_cast<float>(liquid.level_mm + solid_mm);
  for (int y = 0; y < map.cells.height; ++y) {
    for (int x = 0; x < map.cells.width; ++x) {
      HeightCell& cell = map.cells.at(x, y);
      if (is_item(cell.label) && cell.label != liquid.label) continue;
      const Vec2 at = dish.to_dish(map.centre_mm(x, y));
      const double inset = dish.profile.inset_mm(at);
      const bool in_dish = inset > 0.0 && dish.profile.height_mm(at) < liquid.level_mm;
      if (!in_dish) {
        if (cell.label == liquid.label && cell.z_mm < solid) cell.label = kDishLabel;
        continue;
      }
      if (cell.label == liquid.label && cell.kind == CellKind::surface && cell.z_mm > solid) continue;
      cell.label = liquid.label;
      cell.z_mm = level;
    }
  }
}

}  // namespace

LevelLiquid level_liquid(std::span<const SurfaceGrid> views, const InnerSurface& dish,
                         const LevelLiquidParams& params, LevelLiquidWorkspace& workspace, HeightMap& map) {
  const std::uint8_t label = largest_item(map);
  if (label == 0 || workspace.histogram.empty()) return {};
  const double least_mm = dish.profile.bottom_height_mm() + params.min_depth_mm;
  double share = 0.0;
  const double matched_mm = find_level(map, label, params.tolerance_mm, workspace.histogram, share);
  const ContactLevel contact =
      find_contact_level(views, dish, label, params.contact_tolerance_mm, workspace.histogram);
  const bool has_contact = contact.share >= params.min_contact_fraction && contact.level_mm >= least_mm &&
                           std::abs(contact.level_mm - matched_mm) <= params.max_gap_mm;
  if (!has_contact && (share < params.min_level_fraction || matched_mm < least_mm)) return {};
  const LevelLiquid liquid{label, has_contact ? contact.level_mm : matched_mm};
  if (!reaches_wall(map, dish, label, liquid.level_mm, params)) return {};
  make_level(dish, liquid, params, map);
  return liquid;
}

}  // namespace traygauge
