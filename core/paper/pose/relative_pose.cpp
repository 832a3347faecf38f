#include "core/paper/pose/relative_pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/median.hpp"
#include "core/geometry/triangulation.hpp"
#include "core/paper/pose/epipolar.hpp"
#include "core/paper/pose/essential_decomposition.hpp"
#include "core/paper/pose/model_search.hpp"
#include "core/paper/pose/planar_twin.hpp"
#include "core/paper/pose/pose_refinement.hpp"
#include "core/paper/pose/threshold_estimator.hpp"

namespace traygauge::paper {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMinCheiralParallax = 0.1;  // share of min_parallax_deg below which a depth's sign is noise
constexpr double kMinRobustScale_px = 1e-3;  // exact matches: any loss is quadratic there

bool lies_before(const RayMatch& a, const RayMatch& b) {
  if (a.first.x() != b.first.x()) return a.first.x() < b.first.x();
  if (a.first.y() != b.first.y()) return a.first.y() < b.first.y();
  if (a.second.x() != b.second.x()) return a.second.x() < b.second.x();
  return a.second.y() < b.second.y();
}

// Fills workspace.matches with the distinct matches, in their order.
void load_distinct(std::span<const RayMatch> matches, RelativePoseWorkspace& workspace) {
  workspace.matches.clear();
  const std::span<std::uint32_t> order =
      workspace.inliers.first(std::min(matches.size(), workspace.matches.capacity()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    if (lies_before(matches[a], matches[b])) return true;
    return !lies_before(matches[b], matches[a]) && a < b;
  };
  std::make_heap(order.begin(), order.end(), before);
  std::sort_heap(order.begin(), order.end(), before);
  const std::span<double> repeated = workspace.data_px;  // flags
  std::size_t last = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool is_new = k == 0 || lies_before(matches[order[last]], matches[order[k]]);
    repeated[order[k]] = is_new ? 0.0 : 1.0;
    if (is_new) last = k;
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (repeated[i] == 0.0) workspace.matches.push_back(matches[i]);
  }
}

double median_displacement_px(RelativePoseWorkspace& workspace, double focal_px) {
  const std::size_t size = workspace.matches.size();
  for (std::size_t i = 0; i < size; ++i) {
    const RayMatch match = workspace.matches[i];
    workspace.data_px[i] = focal_px * (match.second - match.first).norm();
  }
  return median(workspace.data_px.first(size));
}

double median_parallax_deg(std::span<const std::uint32_t> indices, const Mat3& rotation,
                           RelativePoseWorkspace& workspace) {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    workspace.data_px[k] = parallax_angle_rad(workspace.matches[indices[k]], rotation);
  }
  return median(workspace.data_px.first(indices.size())) / kDegree;
}

double median_distance_px(const Mat3& essential, double focal_px, std::span<const std::uint32_t> indices,
                          RelativePoseWorkspace& workspace) {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    workspace.data_px[k] = symmetric_epipolar_distance_px(essential, workspace.matches[indices[k]], focal_px);
  }
  return median(workspace.data_px.first(indices.size()));
}

// What both entries check first, and the distinct matches in the workspace.
Status prepare(std::span<const RayMatch> matches, double focal_px, const RelativePoseParams& params,
               RelativePoseWorkspace& workspace, std::span<std::uint8_t> inliers) {
  if (!validate(params).ok() || !(focal_px > 0.0) || inliers.size() != matches.size()) {
    return StatusCode::invalid_configuration;
  }
  std::fill(inliers.begin(), inliers.end(), std::uint8_t{0});
  load_distinct(matches, workspace);
  if (workspace.matches.size() < static_cast<std::size_t>(params.min_inliers)) {
    return StatusCode::too_few_matches;
  }
  if (median_displacement_px(workspace, focal_px) < params.min_displacement_px) {
    return StatusCode::views_identical;
  }
  return StatusCode::ok;
}

// Of the four motions of an essential matrix the one that sees most inliers in front of both cameras. Where
// nothing has parallax, that is undecided: then the smaller turn of the rays counts.
Pose choose_motion(const Mat3& essential, std::span<const std::uint32_t> indices,
                   const RelativePoseParams& params, RelativePoseWorkspace& workspace) {
  const std::array<Pose, 4> motions = decompose_essential(essential);
  const double parallax_0 = median_parallax_deg(indices, motions[0].rotation, workspace);
  const double parallax_2 = median_parallax_deg(indices, motions[2].rotation, workspace);
  const bool is_close = std::min(parallax_0, parallax_2) < params.min_parallax_deg;
  const std::size_t begin = is_close && parallax_2 < parallax_0 ? 2 : 0;
  const std::size_t end = is_close ? begin + 2 : 4;
  const double min_parallax_rad = kMinCheiralParallax * params.min_parallax_deg * kDegree;
  Pose best = motions[begin];
  std::size_t most = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t count = count_in_front(workspace.matches, indices, motions[i], min_parallax_rad);
    if (count > most) {
      most = count;
      best = motions[i];
    }
  }
  return best;
}

// Refines on the inliers, selects them anew, and so on; the threshold follows the model.
void refine(double focal_px, const RelativePoseParams& params, const ThresholdEstimator& thresholds,
            RelativePoseWorkspace& workspace, RelativePose& pose) {
  for (int round = 0; round < params.refine_rounds; ++round) {
    const Mat3 essential = essential_matrix(pose.second_from_first);
    const auto indices = list_inliers(essential, focal_px, pose.threshold_px, workspace);
    if (indices.size() < kPoseParameters) return;
    // A robust loss beats plain squares here: an adaptive threshold lets matches pass that are off by pixels.
    const double scale = params.robust_scale * median_distance_px(essential, focal_px, indices, workspace);
    const EpipolarProblem problem(workspace.matches, indices, focal_px, std::max(scale, kMinRobustScale_px));
    LevenbergMarquardtParams minimiser;
    minimiser.max_iterations = params.refine_iterations;
    minimise<kPoseParameters>(problem, minimiser, pose.second_from_first);
    const double threshold = thresholds.threshold_px(essential_matrix(pose.second_from_first));
    if (threshold >= 0.0) pose.threshold_px = threshold;
  }
}

// Replaces the pose by its planar twin where that fits better, by eq. (1) on common ground. At a wide
// threshold the search cannot tell them apart: either has nearly all matches as inliers.
void choose_between_twins(double focal_px, const RelativePoseParams& params,
                          const ThresholdEstimator& thresholds, RelativePoseWorkspace& workspace,
                          RelativePose& pose) {
  const Mat3 essential = essential_matrix(pose.second_from_first);
  const auto indices = list_inliers(essential, focal_px, pose.threshold_px, workspace);
  RelativePose twin = pose;
  if (!find_planar_twin(workspace.matches, indices, pose.second_from_first, twin.second_from_first)) return;
  twin.second_from_first =
      choose_motion(essential_matrix(twin.second_from_first), indices, params, workspace);
  refine(focal_px, params, thresholds, workspace, twin);
  const double fitness = workspace.matches.fitness(essential_matrix(pose.second_from_first), focal_px,
                                                   params.fitness_threshold_px, -1.0);
  const double twin_fitness = workspace.matches.fitness(essential_matrix(twin.second_from_first), focal_px,
                                                        params.fitness_threshold_px, -1.0);
  if (twin_fitness <= fitness) return;
  const auto twin_indices =
      list_inliers(essential_matrix(twin.second_from_first), focal_px, twin.threshold_px, workspace);
  const std::size_t in_front = count_in_front(workspace.matches, twin_indices, twin.second_from_first, 0.0);
  if (2 * in_front > twin_indices.size()) pose = twin;
}

// Fills the report and judges the outcome.
Status conclude(std::span<const RayMatch> matches, double focal_px, const RelativePoseParams& params,
                RelativePoseWorkspace& workspace, RelativePose& pose, std::span<std::uint8_t> inliers) {
  const Mat3 essential = essential_matrix(pose.second_from_first);
  const auto indices = list_inliers(essential, focal_px, pose.threshold_px, workspace);
  if (!is_non_trivial(indices.size(), workspace.matches.size(), params)) return StatusCode::pose_not_found;
  pose.inliers = static_cast<int>(indices.size());
  double sum = 0.0;
  for (const std::uint32_t i : indices) sum += workspace.data_px[i] * workspace.data_px[i];
  pose.rms_px = std::sqrt(sum / static_cast<double>(indices.size()));
  pose.fitness = workspace.matches.fitness(essential, focal_px, params.fitness_threshold_px, -1.0);
  pose.parallax_deg = median_parallax_deg(indices, pose.second_from_first.rotation, workspace);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double distance = symmetric_epipolar_distance_px(essential, matches[i], focal_px);
    inliers[i] = distance <= pose.threshold_px ? 1 : 0;
  }
  return pose.parallax_deg < params.min_parallax_deg ? StatusCode::views_too_close : StatusCode::ok;
}

}  // namespace

Status validate(const RelativePoseParams& params) {
  const bool thresholds_hold = params.fixed_threshold_px > 0.0 && params.min_threshold_px > 0.0 &&
                               params.max_threshold_px >= params.min_threshold_px &&
                               params.fitness_threshold_px > 0.0 && params.robust_scale > 0.0;
  const bool rates_hold = params.max_noise_fraction > 0.0 && params.max_noise_fraction < 1.0 &&
                          params.min_inlier_rate >= 0.0 && params.min_inlier_rate <= 1.0 &&
                          params.confidence > 0.0 && params.confidence < 1.0;
  const bool counts_hold = params.noise_sample > 0 && params.min_inliers >= 6 && params.local_samples >= 5 &&
                           params.local_samples <= 32 && params.local_iterations >= 0 &&
                           params.max_restarts >= 0 && params.min_iterations >= 1 &&
                           params.max_iterations >= 1 && params.refine_iterations >= 0 &&
                           params.refine_rounds >= 0;
  const bool limits_hold = params.min_displacement_px >= 0.0 && params.min_parallax_deg >= 0.0;
  return thresholds_hold && rates_hold && counts_hold && limits_hold ? StatusCode::ok
                                                                     : StatusCode::invalid_configuration;
}

Status estimate_relative_pose(std::span<const RayMatch> matches, double focal_px,
                              const RelativePoseParams& params, Random& random,
                              RelativePoseWorkspace& workspace, RelativePose& pose,
                              std::span<std::uint8_t> inliers) {
  const Status prepared = prepare(matches, focal_px, params, workspace, inliers);
  if (!prepared.ok()) return prepared;
  const ThresholdEstimator thresholds(params, focal_px, random, workspace);
  const FoundModel found = search_model(params, focal_px, thresholds, random, workspace);
  pose = {};
  pose.iterations = found.iterations;
  if (found.threshold_px < 0.0) return StatusCode::pose_not_found;
  pose.threshold_px = found.threshold_px;
  const auto indices = list_inliers(found.essential, focal_px, found.threshold_px, workspace);
  pose.second_from_first = choose_motion(found.essential, indices, params, workspace);
  if (params.refine) {
    refine(focal_px, params, thresholds, workspace, pose);
    choose_between_twins(focal_px, params, thresholds, workspace, pose);
  }
  return conclude(matches, focal_px, params, workspace, pose, inliers);
}

Status refine_relative_pose(std::span<const RayMatch> matches, double focal_px,
                            const RelativePoseParams& params, const Pose& start_second_from_first,
                            Random& random, RelativePoseWorkspace& workspace, RelativePose& pose,
                            std::span<std::uint8_t> inliers) {
  const Status prepared = prepare(matches, focal_px, params, workspace, inliers);
  if (!prepared.ok()) return prepared;
  const ThresholdEstimator thresholds(params, focal_px, random, workspace);
  pose = {};
  pose.second_from_first = start_second_from_first;
  pose.second_from_first.translation.normalize();
  if (!(pose.second_from_first.translation.squaredNorm() > 0.0)) return StatusCode::views_too_close;
  pose.threshold_px = thresholds.threshold_px(essential_matrix(pose.second_from_first));
  if (pose.threshold_px < 0.0) return StatusCode::pose_not_found;
  if (params.refine) refine(focal_px, params, thresholds, workspace, pose);
  return conclude(matches, focal_px, params, workspace, pose, inliers);
}

}  // namespace traygauge::paper
