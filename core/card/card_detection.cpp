#include "core/card/card_detection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/ransac.hpp"
#include "core/card/card_evidence.hpp"
#include "core/card/card_pose.hpp"
#include "core/card/homography.hpp"

namespace traygauge {

namespace {

struct Consensus {
  int count = 0;
  double square_mm2 = 0.0;  // sum over the inliers

  bool beats(const Consensus& other) const {
    return count != other.count ? count > other.count : square_mm2 < other.square_mm2;
  }
};

Consensus flag_inliers(std::span<const CardTrack> tracks, const Mat3& pattern_from_ray, double inlier_mm,
                       std::span<std::uint8_t> inliers) {
  Consensus consensus;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Vec2 mapped;
    inliers[i] = 0;
    if (!map_ray(pattern_from_ray, tracks[i].first, mapped)) continue;
    const double square = (mapped - tracks[i].pattern_mm).squaredNorm();
    if (square > inlier_mm * inlier_mm) continue;
    inliers[i] = 1;
    ++consensus.count;
    consensus.square_mm2 += square;
  }
  return consensus;
}

double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

// A view of the printed side turns no triangle over; a flat triangle fixes nothing.
bool is_good_sample(const std::array<Vec2, kHomographySample>& rays,
                    const std::array<Vec2, kHomographySample>& pattern, double min_area_mm2) {
  for (std::size_t left_out = 0; left_out < kHomographySample; ++left_out) {
    const std::size_t a = (left_out + 1) % kHomographySample;
    const std::size_t b = (left_out + 2) % kHomographySample;
    const std::size_t c = (left_out + 3) % kHomographySample;
    const double on_pattern = doubled_area(pattern[a], pattern[b], pattern[c]);
    if (std::abs(on_pattern) < 2.0 * min_area_mm2) return false;
    if (on_pattern * doubled_area(rays[a], rays[b], rays[c]) <= 0.0) return false;
  }
  return true;
}

// Replaces a homography by the nearest one of a rigid card.
bool make_rigid(Mat3& pattern_from_ray) {
  Pose pose;
  if (!pose_from_homography(pattern_from_ray, pose)) return false;
  pattern_from_ray = homography_from_pose(pose);
  return true;
}

bool draw_hypothesis(std::span<const CardTrack> tracks, const CardModelSize& size,
                     const CardDetectionParams& params, Random& random, Mat3& pattern_from_ray) {
  const auto sample = sample_distinct<kHomographySample>(random, tracks.size());
  std::array<Vec2, kHomographySample> rays;
  std::array<Vec2, kHomographySample> pattern;
  for (std::size_t k = 0; k < kHomographySample; ++k) {
    rays[k] = tracks[sample[k]].first;
    pattern[k] = tracks[sample[k]].pattern_mm;
  }
  if (!is_good_sample(rays, pattern, params.min_triangle_fraction * size.area_mm2())) return false;
  if (!homography_from_four(rays, pattern, pattern_from_ray)) return false;
  return params.model == CardModel::homography || make_rigid(pattern_from_ray);
}

// Least squares on the inliers by the chosen model.
bool refit(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers, const CardParams& params,
           Mat3& pattern_from_ray) {
  if (params.detection.model == CardModel::homography) {
    return fit_homography(tracks, inliers, &CardTrack::first, pattern_from_ray);
  }
  CardPose pose;
  if (!card_pose_from_homography(pattern_from_ray, tracks, inliers, &CardTrack::first, params.pose, pose))
    return false;
  pattern_from_ray = homography_from_pose(pose.camera_from_card);
  return true;
}

// Refits while the inliers do not get fewer.
Consensus polish(std::span<const CardTrack> tracks, const CardParams& params, double inlier_mm,
                 Consensus consensus, CardWorkspace& workspace, Mat3& pattern_from_ray) {
  const auto inliers = workspace.inliers.first(tracks.size());
  const auto trial = workspace.trial_inliers.first(tracks.size());
  for (int round = 0; round < params.detection.refit_rounds; ++round) {
    Mat3 candidate = pattern_from_ray;
    if (!refit(tracks, inliers, params, candidate)) break;
    const Consensus reached = flag_inliers(tracks, candidate, inlier_mm, trial);
    if (reached.count < consensus.count) break;
    pattern_from_ray = candidate;
    consensus = reached;
    std::copy(trial.begin(), trial.end(), inliers.begin());
  }
  return consensus;
}

}  // namespace

Status find_card(std::span<const CardTrack> tracks, const CardModelSize& size, const CardParams& params,
                 Random& random, CardWorkspace& workspace, CardFit& fit) {
  fit = {};
  tracks = tracks.first(std::min(tracks.size(), workspace.inliers.size()));
  const auto inliers = workspace.inliers.first(tracks.size());
  const auto trial = workspace.trial_inliers.first(tracks.size());
  std::fill(inliers.begin(), inliers.end(), std::uint8_t{0});
  fit.inliers = inliers;
  if (tracks.size() <
      std::max<std::size_t>(kHomographySample, static_cast<std::size_t>(params.detection.min_tracks))) {
    return StatusCode::card_not_found;
  }
  const double inlier_mm = params.detection.inlier_fraction * size.length_mm();
  Consensus best;
  IterationBound bound(params.detection.confidence, params.detection.min_iterations,
                       params.detection.max_iterations);
  for (; bound.proceed(); bound.count_iteration()) {
    Mat3 hypothesis;
    if (!draw_hypothesis(tracks, size, params.detection, random, hypothesis)) continue;
    const Consensus consensus = flag_inliers(tracks, hypothesis, inlier_mm, trial);
    if (!consensus.beats(best) || !is_view_of_card(hypothesis, size, params.detection)) continue;
    best = consensus;
    fit.pattern_from_first = hypothesis;
    std::copy(trial.begin(), trial.end(), inliers.begin());
    bound.update(static_cast<double>(best.count) / static_cast<double>(tracks.size()), kHomographySample);
  }
  fit.iterations = bound.iterations();
  if (best.count >= params.detection.min_tracks) {
    best = polish(tracks, params, inlier_mm, best, workspace, fit.pattern_from_first);
  }
  fit.inlier_count = best.count;
  if (best.count < std::max(params.detection.min_tracks, kHomographySample))
    return StatusCode::card_not_found;
  fit.rms_mm = std::sqrt(best.square_mm2 / best.count);
  fit.log10_false_alarms = log10_false_alarms(tracks, inliers, inlier_mm, size);
  const bool is_chance = fit.log10_false_alarms > std::log10(params.detection.max_false_alarms);
  const bool is_crowded =
      least_spread_mm(tracks, inliers) < params.detection.min_spread_fraction * size.length_mm();
  if (is_chance || is_crowded || !is_view_of_card(fit.pattern_from_first, size, params.detection)) {
    return StatusCode::card_not_found;
  }
  return {};
}

}  // namespace traygauge
