// The disparities to search, from the sparse matches (paper III-B-2, "Disparity range").
#pragma once

#include <span>

#include "core/base/status.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge::paper {

struct DisparityRangeParams {
  double share = 0.90;      // of the matches, the central ones (paper III-B-2)
  int enlargement_px = 16;  // at each side; 4 % of the 400 px that a dish of 2^17 px measures: at 15 degrees
                            // between the views about 40 mm of height that no match happens to show
  int min_matches = 8;      // below it the tails cannot be told from mismatches
  int max_count = 192;      // disparities that memory is kept for
};

// `match_disparities_px` is reordered. too_few_matches, or disparity_range_too_large beyond max_count or
// kMaxDisparityPx.
Status estimate_disparity_range(std::span<double> match_disparities_px, const DisparityRangeParams& params,
                                DisparityRange& range);

}  // namespace traygauge::paper
