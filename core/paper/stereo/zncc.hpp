// Zero-mean normalised cross-correlation of square windows, an alternative cost of the paper (Table III).
#pragma once

#include <span>

#include "core/paper/stereo/block_rows.hpp"
#include "core/paper/stereo/local_cost.hpp"
#include "core/paper/stereo/stereo_params.hpp"

namespace traygauge::paper {

// Sums of one window, over the rows of a block.
struct WindowMoments {
  std::int32_t sum[kRowLanes];
  float inverse_deviation[kRowLanes];  // 0 where the window is uniform
};

struct WindowProducts {
  std::int32_t sum[kRowLanes];
};

struct CorrelationWorkspace {
  std::span<WindowMoments> first;
  std::span<WindowMoments> second;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_columns) {
    first = arena.template take<WindowMoments>(static_cast<std::size_t>(max_columns));
    second = arena.template take<WindowMoments>(static_cast<std::size_t>(max_columns));
  }
};

// Moments of all windows of a block.
void prepare_correlation(const MatchingBlock& block, int radius_px, CorrelationWorkspace& workspace);

// zncc_weight · window area · (1 − correlation) at the disparities of `interval`, with the rules of
// local_costs() for masks.
void correlation_costs(const MatchingBlock& block, int x, Interval interval, const StereoParams& params,
                       CorrelationWorkspace& workspace, CostLanes* costs);

}  // namespace traygauge::paper
