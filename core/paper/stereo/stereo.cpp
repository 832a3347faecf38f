#include "core/paper/stereo/stereo.hpp"

#include <algorithm>

#include "core/paper/stereo/census.hpp"
#include "core/paper/stereo/smoothness.hpp"
#include "core/stereo/median.hpp"
#include "core/stereo/subpixel.hpp"

namespace traygauge::paper {
namespace {

template <class T>
ImageView<T> resized(ImageView<T> storage, int width, int height) {
  return {storage.data, width, height};
}

StereoPair halve_pair(const StereoPair& pair, StereoWorkspace::Level& storage) {
  const int height = halved(pair.first.height);
  const auto first = resized(storage.first, halved(pair.first.width), height);
  const auto first_mask = resized(storage.first_mask, halved(pair.first.width), height);
  const auto second = resized(storage.second, halved(pair.second.width), height);
  const auto second_mask = resized(storage.second_mask, halved(pair.second.width), height);
  halve(pair.first, first);
  halve_mask(pair.first_mask, first_mask);
  halve(pair.second, second);
  halve_mask(pair.second_mask, second_mask);
  return {first, first_mask, second, second_mask};
}

void prepare_costs(const StereoParams& params, StereoWorkspace& workspace) {
  MatchingBlock& block = workspace.block;
  if (params.cost == MatchingCost::census) {
    transform_census(block.first, params.census_radius_px, block.first_codes);
    transform_census(block.second, params.census_radius_px, block.second_codes);
  } else if (params.cost == MatchingCost::zncc) {
    prepare_correlation(block, params.window_radius_px, workspace.correlation);
  }
}

// Aggregated costs of all states of the block.
void aggregate_costs(Interval columns, const StereoParams& params, StereoWorkspace& workspace) {
  const int width = workspace.block.first.width;
  const int radius = params.window_radius_px;
  const std::span<const Interval> bands = workspace.states.bands.first(static_cast<std::size_t>(width));
  std::int32_t offset = 0;
  int added = std::max(columns.lo - radius, 0);
  for (int x = columns.lo; x <= columns.hi; ++x) {
    const Interval band = bands[static_cast<std::size_t>(x)];
    workspace.states.offsets[static_cast<std::size_t>(x)] = offset;
    offset += band.count();
    CostLanes* costs = workspace.states.costs_of(x);
    if (params.cost == MatchingCost::zncc) {
      correlation_costs(workspace.block, x, band, params, workspace.correlation, costs);
      continue;
    }
    for (; added <= std::min(x + radius, width - 1); ++added) {
      add_column(workspace.block, added, needed_disparities(bands, added, radius), params, workspace.sums);
    }
    sum_window(workspace.sums, x, width, band, radius, costs);
  }
}

Disparity refine(const PathStates& states, int x, int row, int d) {
  const Interval band = states.bands[static_cast<std::size_t>(x)];
  int offset = 0;
  if (d > band.lo && d < band.hi) {
    const CostLanes* costs = states.costs_of(x) + (d - band.lo);
    offset = parabola_offset(costs[-1][row], costs[0][row], costs[1][row]);
  }
  return static_cast<Disparity>(kDisparityScale * d + offset);
}

// Whether a pixel's range meets the second mask anywhere.
bool has_partner(const StereoPair& pair, int x, int y, DisparityRange range) {
  const std::uint8_t* mask = pair.second_mask.row(y);
  const int end = std::min(x + range.max_px, pair.second.width - 1);
  for (int partner = std::max(x + range.min_px, 0); partner <= end; ++partner) {
    if (mask[partner] != 0) return true;
  }
  return false;
}

void write_rows(const StereoPair& pair, int top, Interval columns, DisparityRange range,
                const StereoWorkspace& workspace, ImageView<Disparity> disparity) {
  const int rows = std::min(kRowLanes, pair.first.height - top);
  for (int r = 0; r < rows; ++r) {
    Disparity* target = disparity.row(top + r);
    const std::uint8_t* mask = pair.first_mask.row(top + r);
    std::fill_n(target, disparity.width, kNoDisparity);
    for (int x = columns.lo; x <= columns.hi; ++x) {
      if (mask[x] == 0 || !has_partner(pair, x, top + r, range)) continue;
      const int d = workspace.paths[static_cast<std::size_t>(x)][r];
      target[x] = refine(workspace.states, x, r, d);
    }
  }
}

// One level; `coarse` is the coarser level's result, empty at the coarsest.
void match_level(const StereoPair& pair, ImageView<const Disparity> coarse, DisparityRange range,
                 const StereoParams& params, StereoWorkspace& workspace, ImageView<Disparity> disparity) {
  PathStates& states = workspace.states;
  const auto width = static_cast<std::size_t>(pair.first.width);
  for (int top = 0; top < pair.first.height; top += kRowLanes) {
    load_block(pair.first, pair.first_mask, top, workspace.block.first);
    load_block(pair.second, pair.second_mask, top, workspace.block.second);
    const Interval columns = masked_columns(workspace.block.first);
    if (!columns.empty()) {
      if (coarse.empty()) {
        open_bands(range, columns, states.bands.first(width));
      } else {
        narrow_bands(coarse, top, range, params, columns, states.bands.first(width));
      }
      prepare_costs(params, workspace);
      smoothness_costs(workspace.block.first, params, workspace.smoothness);
      aggregate_costs(columns, params, workspace);
      find_best_paths(states, columns, workspace.smoothness, workspace.paths);
    }
    write_rows(pair, top, columns, range, workspace, disparity);
  }
}

}  // namespace

Status match_dense(ImageView<const std::uint8_t> first, ImageView<const std::uint8_t> first_mask,
                   ImageView<const std::uint8_t> second, ImageView<const std::uint8_t> second_mask,
                   DisparityRange range, const StereoParams& params, StereoWorkspace& workspace,
                   ImageView<Disparity> disparity) {
  if (const Status valid = validate(params); !valid.ok()) return valid;
  if (std::max(first.width, second.width) > workspace.max_columns || first.height > workspace.max_rows) {
    return StatusCode::out_of_memory;
  }
  if (range.min_px < -kMaxDisparityPx || range.max_px > kMaxDisparityPx || range.max_px < range.min_px ||
      range.count() > workspace.max_disparities) {
    return StatusCode::disparity_range_too_large;
  }
  std::array<StereoPair, kMaxLevels> pairs{};
  pairs[0] = {first, first_mask, second, second_mask};
  for (int level = 1; level < params.levels; ++level) {
    const auto l = static_cast<std::size_t>(level);
    pairs[l] = halve_pair(pairs[l - 1], workspace.coarser[l]);
  }
  ImageView<const Disparity> coarse;
  for (int level = params.levels - 1; level >= 0; --level) {
    const auto l = static_cast<std::size_t>(level);
    const StereoPair& pair = pairs[l];
    const auto target =
        level == 0 ? disparity : resized(workspace.coarser[l].disparity, pair.first.width, pair.first.height);
    const auto unfiltered = resized(workspace.unfiltered, pair.first.width, pair.first.height);
    match_level(pair, coarse, range_at_level(range, level), params, workspace, unfiltered);
    filter_median(unfiltered, params.median_radius_px, target);
    coarse = target;
  }
  return {};
}

}  // namespace traygauge::paper
