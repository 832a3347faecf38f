// The cost of a change of disparity: inversely related to the local variance, so that visually smooth areas
// are smooth in depth (paper III-B-2, "Optimization").
#pragma once

#include <span>

#include "core/paper/stereo/block_rows.hpp"
#include "core/paper/stereo/row_block.hpp"
#include "core/paper/stereo/stereo_params.hpp"

namespace traygauge::paper {

inline constexpr int kMaxVarianceRadius = -kFirstPixelRow;

// Cost of one pixel of change between columns x − 1 and x, in window sums of the local cost:
// smoothness · window area / (1 + variance / smoothness_deviation²), rounded down, at least 1.
void smoothness_costs(const BlockPicture& picture, const StereoParams& params, std::span<CostLanes> costs);

}  // namespace traygauge::paper
