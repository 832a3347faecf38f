// Sums of local costs over the square window (paper III-B-2, "Aggregation").
#pragma once

#include <array>
#include <span>

#include "core/paper/stereo/block_rows.hpp"
#include "core/paper/stereo/local_cost.hpp"
#include "core/paper/stereo/stereo_params.hpp"

namespace traygauge::paper {

// Slides along a block from left to right and keeps one window's width of column sums.
struct WindowSums {
  static constexpr int kMaxColumns = 2 * kMaxWindowRadius + 1;
  std::span<ByteLanes> local;                     // costs of one column
  std::span<CostLanes> columns;                   // kMaxColumns rings of vertical sums
  std::array<Interval, kMaxColumns> intervals{};  // the disparities that they cover
  std::size_t stride = 0;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_disparities) {
    stride = static_cast<std::size_t>(max_disparities);
    local = arena.template take<ByteLanes>(stride);
    columns = arena.template take<CostLanes>(stride * kMaxColumns);
  }
};

// The disparities at which column x is needed: those of all windows that contain it.
Interval needed_disparities(std::span<const Interval> bands, int x, int radius_px);

// Sums column x of the block over the window's rows.
void add_column(const MatchingBlock& block, int x, Interval interval, const StereoParams& params,
                WindowSums& sums);

// Window sums around column x (columns x − radius … x + radius have been added): interval.count() lanes.
void sum_window(const WindowSums& sums, int x, int width, Interval interval, int radius_px, CostLanes* costs);

}  // namespace traygauge::paper
