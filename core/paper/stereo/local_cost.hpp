// The dissimilarity of two pixels (paper III-B-2, "Matching cost"): census, or the absolute difference of the
// grey values. ZNCC compares whole windows and has a file of its own.
#pragma once

#include <span>

#include "core/paper/stereo/block_rows.hpp"
#include "core/paper/stereo/census.hpp"
#include "core/paper/stereo/row_block.hpp"
#include "core/paper/stereo/stereo_params.hpp"

namespace traygauge::paper {

// Both pictures over a block's rows, and what the costs need of them.
struct MatchingBlock {
  BlockPicture first;
  BlockPicture second;
  std::span<ByteLanes> first_codes;  // census
  std::span<ByteLanes> second_codes;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_columns, const StereoParams& params) {
    first.allocate(arena, max_columns);
    second.allocate(arena, max_columns);
    if (params.cost != MatchingCost::census) return;
    const auto codes = static_cast<std::size_t>(max_columns) *
                       static_cast<std::size_t>(census_bytes(params.census_radius_px));
    first_codes = arena.template take<ByteLanes>(codes);
    second_codes = arena.template take<ByteLanes>(codes);
  }
};

// Costs of column x of the first picture at the disparities of `interval`, one ByteLanes each. A pixel
// outside the first mask costs nothing, a partner outside the second mask or picture costs the most.
void local_costs(const MatchingBlock& block, int x, Interval interval, const StereoParams& params,
                 ByteLanes* costs);

// What a partner outside the second mask costs.
int highest_local_cost(const StereoParams& params);

}  // namespace traygauge::paper
