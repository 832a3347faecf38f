#include "core/paper/card/scale_estimation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/ransac.hpp"
#include "core/card/card_pose.hpp"
#include "core/card/homography.hpp"
#include "core/paper/base/half_sample_mode.hpp"

namespace traygauge::paper {

namespace {

// Appends the ratio of one pair unless the points are too near each other.
void add_ratio(const CardTrack& a, const CardTrack& b, double min_distance_mm, BoundedList<double>& ratios) {
  const double on_pattern = (a.pattern_mm - b.pattern_mm).norm();
  const double in_cloud = (a.point_in_first - b.point_in_first).norm();
  if (on_pattern >= min_distance_mm && in_cloud > 0.0) ratios.push_back(on_pattern / in_cloud);
}

std::span<const std::int32_t> list_inliers(std::span<const std::uint8_t> inliers,
                                           std::span<std::int32_t> indices) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < inliers.size() && count < indices.size(); ++i) {
    if (inliers[i] != 0) indices[count++] = static_cast<std::int32_t>(i);
  }
  return indices.first(count);
}

void collect_ratios(std::span<const CardTrack> tracks, std::span<const std::int32_t> points,
                    double min_distance_mm, Random& random, BoundedList<double>& ratios) {
  const auto track = [&](std::size_t i) -> const CardTrack& {
    return tracks[static_cast<std::size_t>(points[i])];
  };
  const std::size_t count = points.size();
  if (count < 2) return;
  if (count * (count - 1) / 2 <= ratios.capacity()) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) add_ratio(track(i), track(j), min_distance_mm, ratios);
    }
    return;
  }
  for (std::size_t draw = 0; draw < ratios.capacity(); ++draw) {
    const auto pair = sample_distinct<2>(random, count);
    add_ratio(track(pair[0]), track(pair[1]), min_distance_mm, ratios);
  }
}

// Baselines become mm by the length of the motion that the card itself saw.
bool scale_from_card_motion(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                            const CardPoseParams& params, double& mm_per_baseline) {
  CardPose pose[2];
  const CardView views[2] = {&CardTrack::first, &CardTrack::second};
  for (std::size_t v = 0; v < 2; ++v) {
    Mat3 homography;
    if (!fit_homography(tracks, inliers, views[v], homography) ||
        !card_pose_from_homography(homography, tracks, inliers, views[v], params, pose[v])) {
      return false;
    }
  }
  mm_per_baseline = motion_from_card(pose[0].camera_from_card, pose[1].camera_from_card).translation.norm();
  return mm_per_baseline > 0.0;
}

}  // namespace

Status estimate_scale(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, const CardScaleParams& params, Random& random,
                      CardScaleWorkspace& workspace, ScaleEstimate& estimate) {
  estimate = {};
  const auto points = list_inliers(inliers, workspace.indices);
  BoundedList<double> ratios(workspace.ratios);
  collect_ratios(tracks, points, params.scale.min_distance_fraction * card_length_mm, random, ratios);
  estimate.pairs = static_cast<int>(ratios.size());
  if (ratios.empty() || estimate.pairs < params.scale.min_pairs) return StatusCode::scale_not_found;
  std::sort(ratios.begin(), ratios.end());
  const std::size_t count = ratios.size();
  switch (params.scale.method) {
    case ScaleMethod::half_sample_mode:
      estimate.mm_per_baseline = half_sample_mode(ratios.items(), params.scale.mode);
      break;
    case ScaleMethod::median:
      estimate.mm_per_baseline = 0.5 * (ratios[(count - 1) / 2] + ratios[count / 2]);
      break;
    case ScaleMethod::card_motion:
      if (!scale_from_card_motion(tracks, inliers, params.pose, estimate.mm_per_baseline)) {
        return StatusCode::scale_not_found;
      }
      break;
  }
  estimate.spread = (ratios[count - 1 - count / 4] - ratios[count / 4]) / estimate.mm_per_baseline;
  if (!(estimate.spread <= params.scale.max_spread)) return StatusCode::scale_not_found;
  return {};
}

}  // namespace traygauge::paper
