#include "core/paper/stereo/disparity_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace traygauge::paper {

Status estimate_disparity_range(std::span<double> match_disparities_px, const DisparityRangeParams& params,
                                DisparityRange& range) {
  const std::size_t count = match_disparities_px.size();
  if (count < static_cast<std::size_t>(std::max(params.min_matches, 1))) return StatusCode::too_few_matches;
  std::sort(match_disparities_px.begin(), match_disparities_px.end());
  const double tail = (1.0 - params.share) / 2.0;
  const auto cut = static_cast<std::size_t>(std::lround(tail * static_cast<double>(count)));
  const double low = std::floor(match_disparities_px[cut]) - params.enlargement_px;
  const double high = std::ceil(match_disparities_px[count - 1 - cut]) + params.enlargement_px;
  const bool fits = low >= -kMaxDisparityPx && high <= kMaxDisparityPx && high - low < params.max_count;
  if (!fits) return StatusCode::disparity_range_too_large;
  range = {static_cast<int>(low), static_cast<int>(high)};
  return {};
}

}  // namespace traygauge::paper
