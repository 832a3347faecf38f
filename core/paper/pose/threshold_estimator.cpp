#include "core/paper/pose/threshold_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge::paper {
namespace {

// 2 D / A of the box around points, in 1/px (Moisan et al. [30], eq. 8). The box of the matched points stands
// for the picture: noise falls nowhere else.
double band_probability_per_px(const Vec2& low, const Vec2& high, double focal_px) {
  const Vec2 size = focal_px * (high - low);
  const double area = size.x() * size.y();
  return area > 0.0 ? 2.0 * size.norm() / area : 1.0;
}

}  // namespace

ThresholdEstimator::ThresholdEstimator(const RelativePoseParams& params, double focal_px, Random& random,
                                       RelativePoseWorkspace& workspace)
    : params_(params), focal_px_(focal_px), workspace_(workspace) {
  if (params.threshold == InlierThreshold::false_discovery) draw_noise(random);
  if (params.threshold == InlierThreshold::a_contrario) measure_area();
}

// "Randomly matching existing points together": a first point with the second point of another match.
void ThresholdEstimator::draw_noise(Random& random) {
  const MatchTable& matches = workspace_.matches;
  workspace_.noise.clear();
  const auto count = static_cast<std::uint32_t>(matches.size());
  if (count < 2) return;
  for (int k = 0; k < params_.noise_sample; ++k) {
    const std::uint32_t i = random.below(count);
    const std::uint32_t j = (i + 1 + random.below(count - 1)) % count;
    if (!workspace_.noise.push_back({matches[i].first, matches[j].second})) return;
  }
}

void ThresholdEstimator::measure_area() {
  const MatchTable& matches = workspace_.matches;
  RayMatch low = matches[0];
  RayMatch high = matches[0];
  for (std::size_t i = 1; i < matches.size(); ++i) {
    const RayMatch match = matches[i];
    low = {low.first.cwiseMin(match.first), low.second.cwiseMin(match.second)};
    high = {high.first.cwiseMax(match.first), high.second.cwiseMax(match.second)};
  }
  a_contrario_.band_probability_per_px =
      std::max(band_probability_per_px(low.first, high.first, focal_px_),
               band_probability_per_px(low.second, high.second, focal_px_));
  fill_log_factorials(workspace_.log_factorials.first(matches.size() + 1));
}

double ThresholdEstimator::threshold_px(const Mat3& essential) const {
  if (params_.threshold == InlierThreshold::fixed) return params_.fixed_threshold_px;
  const std::span<double> data = workspace_.data_px.first(workspace_.matches.size());
  workspace_.matches.measure_distances(essential, focal_px_, data);
  double threshold = 0.0;
  if (params_.threshold == InlierThreshold::a_contrario) {
    threshold =
        a_contrario_threshold_px(data, a_contrario_, workspace_.log_factorials, params_.max_threshold_px);
  } else {
    const std::span<double> noise = workspace_.noise_px.first(workspace_.noise.size());
    workspace_.noise.measure_distances(essential, focal_px_, noise);
    threshold =
        false_discovery_threshold_px(data, noise, params_.max_noise_fraction, params_.max_threshold_px);
  }
  return threshold < 0.0 ? threshold : std::max(threshold, params_.min_threshold_px);
}

}  // namespace traygauge::paper
