#include "core/paper/pipeline/extrinsic_calibration.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/card/card_pose.hpp"
#include "core/card/homography.hpp"
#include "core/geometry/triangulation.hpp"
#include "core/labels/label_regions.hpp"
#include "core/paper/card/card_tracks.hpp"
#include "core/paper/pose/epipolar.hpp"
#include "core/paper/pose/model_search.hpp"

namespace traygauge::paper {
namespace {

bool has_given(const ExtrinsicInput& input) {
  return !input.given->matches.empty();
}

// Matches of the two views, and of each view with the card; returns the rays of the former.
std::span<const RayMatch> match_views(const ExtrinsicInput& input, const MatcherParams& params,
                                      ExtrinsicWorkspace& workspace, bool& capped) {
  if (has_given(input)) {
    capped = input.given->matches.dropped() > 0;
    return input.given->matches.items();
  }
  match_features(input.first->features(), input.second->features(), params, workspace.matcher,
                 workspace.view_matches);
  match_features(input.first->features(), input.pattern, params, workspace.matcher,
                 workspace.first_pattern_matches);
  match_features(input.second->features(), input.pattern, params, workspace.matcher,
                 workspace.second_pattern_matches);
  capped = workspace.view_matches.dropped() > 0;
  for (std::size_t i = 0; i < workspace.view_matches.size(); ++i) {
    const Match& match = workspace.view_matches[i];
    workspace.rays[i] = {input.first->rays()[static_cast<std::size_t>(match.first)],
                         input.second->rays()[static_cast<std::size_t>(match.second)]};
  }
  return workspace.rays.first(workspace.view_matches.size());
}

Status find_pose(const ExtrinsicInput& input, std::span<const RayMatch> rays, double focal_px,
                 const RelativePoseParams& params, Random& random, ExtrinsicWorkspace& workspace,
                 RelativePose& pose, std::span<std::uint8_t> inliers) {
  if (input.motion_search == nullptr)
    return estimate_relative_pose(rays, focal_px, params, random, workspace.pose, pose, inliers);
  Pose start;
  if (!input.motion_search->find_motion(rays, focal_px, random, start)) return StatusCode::pose_not_found;
  return refine_relative_pose(rays, focal_px, params, start, random, workspace.pose, pose, inliers);
}

// Given card points are not checked by anyone before: single ones that disagree with the motion are
// mismatches. When most do, the card itself has moved; all are kept, and check_against_card() says so.
void collect_given_tracks(const GivenCorrespondences& given, double focal_px, const RelativePose& found,
                          BoundedList<CardTrack>& tracks) {
  const Mat3 essential = essential_matrix(found.second_from_first);
  const auto agrees = [&](const CardTrack& track) {
    return symmetric_epipolar_distance_px(essential, {track.first, track.second}, focal_px) <=
           found.threshold_px;
  };
  const auto all = given.card_tracks.items();
  const bool has_moved = 2 * std::count_if(all.begin(), all.end(), agrees) < std::ssize(all);
  for (CardTrack track : all) {
    if (!has_moved && !agrees(track)) continue;
    if (triangulate({track.first, track.second}, found.second_from_first, track.point_in_first))
      tracks.push_back(track);
  }
}

// The card's points seen in both views, as part of the sparse cloud.
void collect_tracks(const ExtrinsicInput& input, std::span<const RayMatch> rays, double focal_px,
                    const RelativePose& found, ExtrinsicWorkspace& workspace) {
  workspace.tracks.clear();
  if (has_given(input)) {
    collect_given_tracks(*input.given, focal_px, found, workspace.tracks);
    return;
  }
  const Pose& pose = found.second_from_first;
  const std::size_t count = rays.size();
  triangulate_all(rays, workspace.inliers.first(count), pose, workspace.cloud.first(count),
                  workspace.triangulated.first(count));
  build_card_tracks(
      {workspace.view_matches.items(), workspace.triangulated.first(count), workspace.cloud.first(count),
       workspace.first_pattern_matches.items(), workspace.second_pattern_matches.items(), input.first->rays(),
       input.second->rays(), input.pattern_mm},
      workspace.tracks);
}

// The camera's motion as the card alone shows it; false when its pose in a view is not to be had.
bool motion_of_card(const CardFit& fit, const CardPoseParams& params, ExtrinsicWorkspace& workspace,
                    Pose& motion) {
  const auto tracks = workspace.tracks.items();
  Mat3 pattern_from_second;
  CardPose first;
  CardPose second;
  if (!fit_homography(tracks, fit.inliers, &CardTrack::second, pattern_from_second)) return false;
  if (!card_pose_from_homography(fit.pattern_from_first, tracks, fit.inliers, &CardTrack::first, params,
                                 first)) {
    return false;
  }
  if (!card_pose_from_homography(pattern_from_second, tracks, fit.inliers, &CardTrack::second, params,
                                 second)) {
    return false;
  }
  motion = motion_from_card(first.camera_from_card, second.camera_from_card);
  return true;
}

bool lies_on_card(const PreparedView& view, const Vec2& ray) {
  const Vec2 pixel = view.lens.pixel(ray);
  const auto x = static_cast<int>(std::lround(pixel.x()));
  const auto y = static_cast<int>(std::lround(pixel.y()));
  return view.labels.contains(x, y) && view.labels.at(x, y) == kCardLabel;
}

// Views of different scenes share the card at most. That is a small plane, and a turn of the camera alone
// explains it: what looks like views too close to each other has hardly an inlier elsewhere.
Status explain_closeness(const ExtrinsicInput& input, std::span<const RayMatch> rays,
                         std::span<const std::uint8_t> inliers, const RelativePoseParams& params) {
  std::size_t beside_card = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (inliers[i] == 0 || lies_on_card(*input.first, rays[i].first)) continue;
    if (!lies_on_card(*input.second, rays[i].second)) ++beside_card;
  }
  return is_non_trivial(beside_card, rays.size(), params) ? StatusCode::views_too_close
                                                          : StatusCode::too_few_matches;
}

double rotation_between_deg(const Pose& a, const Pose& b) {
  return rotation_angle_deg(a.rotation.transpose() * b.rotation);
}

// Table, dish and card lie near one plane, where five points allow a second, twisted motion that cheirality
// may pass: the card's own motion tells them apart.
Status check_against_card(std::span<const RayMatch> rays, double focal_px, const CardFit& fit,
                          const Configuration& configuration, Random& random, ExtrinsicWorkspace& workspace,
                          RelativePose& pose, bool& pose_from_card) {
  Pose motion;
  if (!motion_of_card(fit, configuration.card_search.pose, workspace, motion)) return StatusCode::ok;
  const double tolerance_deg = configuration.view.max_card_rotation_deg;
  if (rotation_between_deg(motion, pose.second_from_first) <= tolerance_deg) return StatusCode::ok;
  RelativePose from_card;
  const auto flags = workspace.card_motion_inliers.first(rays.size());
  const Status refined = refine_relative_pose(rays, focal_px, configuration.pose, motion, random,
                                              workspace.pose, from_card, flags);
  if (!refined.ok() || rotation_between_deg(motion, from_card.second_from_first) > tolerance_deg ||
      from_card.fitness < configuration.view.min_card_pose_fitness * pose.fitness) {
    return StatusCode::pose_contradicts_card;
  }
  pose = from_card;
  pose_from_card = true;
  std::copy(flags.begin(), flags.end(), workspace.inliers.begin());
  return StatusCode::ok;
}

// Scale of the sparse cloud and the table's plane from the card's tracks.
Status scale_by_card(const CardFit& fit, const Pose& pose, const Configuration& configuration, Random& random,
                     ExtrinsicWorkspace& workspace, MeasurementReport& report, Extrinsics& extrinsics) {
  const auto tracks = workspace.tracks.items();
  const double length_mm = configuration.card.size().length_mm();
  ScaleEstimate scale;
  Status status = estimate_scale(tracks, fit.inliers, length_mm, configuration.card_search.scale, random,
                                 workspace.card, scale);
  if (!status.ok()) return status;
  report.mm_per_baseline = scale.mm_per_baseline;
  extrinsics.second_from_first = {pose.rotation, pose.translation * scale.mm_per_baseline};

  Plane print;
  status = fit_card_plane(tracks, fit.inliers, length_mm, scale.mm_per_baseline,
                          configuration.card_search.plane, random, workspace.card, print);
  if (!status.ok()) return status;
  extrinsics.table = print.raised(-configuration.card.thickness_mm);
  extrinsics.card_points.clear();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (fit.inliers[i] != 0)
      extrinsics.card_points.push_back(tracks[i].point_in_first * scale.mm_per_baseline);
  }
  return StatusCode::ok;
}

}  // namespace

Status calibrate_extrinsics(const ExtrinsicInput& input, const Configuration& configuration, Random& random,
                            ExtrinsicWorkspace& workspace, StageClock& clock, MeasurementReport& report,
                            Extrinsics& extrinsics) {
  clock.enter(Stage::matching);
  const auto rays = match_views(input, configuration.matcher, workspace, extrinsics.matches_capped);
  report.matches = static_cast<int>(rays.size());

  clock.enter(Stage::pose);
  const double focal_px =
      0.5 * (input.first->lens.pinhole.mean_focal_px() + input.second->lens.pinhole.mean_focal_px());
  const auto inliers = workspace.inliers.first(rays.size());
  RelativePose pose;
  Status status = find_pose(input, rays, focal_px, configuration.pose, random, workspace, pose, inliers);
  if (status.code() == StatusCode::views_too_close) {
    return explain_closeness(input, rays, inliers, configuration.pose);
  }
  if (!status.ok()) return status;

  clock.enter(Stage::scale);
  const CardModelSize card = configuration.card.size();
  CardFit fit;
  collect_tracks(input, rays, focal_px, pose, workspace);
  report.card_tracks = static_cast<int>(workspace.tracks.size());
  status = find_card(workspace.tracks.items(), card, configuration.card_search, random, workspace.card, fit);
  if (!status.ok()) return status;
  extrinsics.pose_from_card = false;
  status = check_against_card(rays, focal_px, fit, configuration, random, workspace, pose,
                              extrinsics.pose_from_card);
  if (!status.ok()) return status;
  if (extrinsics.pose_from_card) {
    collect_tracks(input, rays, focal_px, pose, workspace);
    status =
        find_card(workspace.tracks.items(), card, configuration.card_search, random, workspace.card, fit);
    if (!status.ok()) return status;
  }
  report.card_tracks = fit.inlier_count;
  report.inliers = pose.inliers;
  report.inlier_threshold_px = pose.threshold_px;
  report.pose_iterations = pose.iterations;
  extrinsics.inliers.clear();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (inliers[i] != 0) extrinsics.inliers.push_back(rays[i]);
  }
  return scale_by_card(fit, pose.second_from_first, configuration, random, workspace, report, extrinsics);
}

}  // namespace traygauge::paper
