// The path of least cost along each row of a block (paper III-B-2, "Optimization").
#pragma once

#include <span>

#include "core/paper/stereo/block_rows.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge::paper {

// Costs and predecessors of all (column, disparity) states of a block, column after column.
struct PathStates {
  std::span<CostLanes> costs;         // aggregated
  std::span<CostLanes> predecessors;  // the disparity that the best path has one column earlier
  std::span<Interval> bands;          // per column; empty outside the mask
  std::span<std::int32_t> offsets;    // of a column's first state
  std::span<CostLanes> paths;         // path costs of two columns, each max_disparities long

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_columns, int max_disparities) {
    const auto columns = static_cast<std::size_t>(max_columns);
    const auto disparities = static_cast<std::size_t>(max_disparities);
    costs = arena.template take<CostLanes>(columns * disparities);
    predecessors = arena.template take<CostLanes>(columns * disparities);
    bands = arena.template take<Interval>(columns);
    offsets = arena.template take<std::int32_t>(columns);
    paths = arena.template take<CostLanes>(2 * disparities);
  }
  CostLanes* costs_of(int x) const {
    return &costs[static_cast<std::size_t>(offsets[static_cast<std::size_t>(x)])];
  }
  CostLanes* predecessors_of(int x) const {
    return &predecessors[static_cast<std::size_t>(offsets[static_cast<std::size_t>(x)])];
  }
};

// Finds, for each row, the disparities d(x) over `columns` that minimise
//   Σ cost(x, d(x)) + Σ smoothness(x) · |d(x) − d(x − 1)|   with d(x) ≥ d(x − 1) − 1
// and writes them, one CostLanes a column. The constraint is the order of [34]: partners in the second
// picture never go backwards, so what only the first camera sees becomes a ramp. A column that no state of
// the last one reaches in that way starts anew. Min-convolution makes it O(columns · disparities). Of equal
// paths the one that keeps its disparity wins, then the one from the largest smaller disparity.
void find_best_paths(const PathStates& states, Interval columns, std::span<const CostLanes> smoothness,
                     std::span<CostLanes> disparities);

}  // namespace traygauge::paper
