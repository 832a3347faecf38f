#include "core/paper/stereo/stereo_params.hpp"

#include "core/base/is_within.hpp"
#include "core/paper/stereo/block_rows.hpp"
#include "core/paper/stereo/hierarchy.hpp"
#include "core/paper/stereo/smoothness.hpp"
#include "core/stereo/median.hpp"

namespace traygauge::paper {

Status validate(const StereoParams& params) {
  constexpr int kWidestBand = 1 << 10;
  constexpr double kHighest = 1e3;
  const bool valid =
      params.cost <= MatchingCost::zncc && is_within(params.census_radius_px, 1, kMaxCensusRadius) &&
      is_within(params.sad_limit, 1, 255) && is_within(params.zncc_weight, 0.0, 48.0) &&
      is_within(params.window_radius_px, 0, kMaxWindowRadius) && is_within(params.levels, 1, kMaxLevels) &&
      is_within(params.band_px, 0, kWidestBand) && is_within(params.band_reach_px, 0, kWidestBand) &&
      is_within(params.smoothness, 0.0, kHighest) && params.smoothness_deviation > 0.0 &&
      is_within(params.smoothness_deviation, 0.0, kHighest) &&
      is_within(params.variance_radius_px, 1, kMaxVarianceRadius) &&
      is_within(params.median_radius_px, 0, kMaxMedianRadius);
  return valid ? Status{} : Status{StatusCode::invalid_configuration};
}

}  // namespace traygauge::paper
