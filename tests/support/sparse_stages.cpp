#include "tests/support/sparse_stages.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/tracking/pose_correction.hpp"
#include "tests/core/paper/motion_scenes.hpp"
#include "tests/core/stereo/capture_scene.hpp"

namespace traygauge::test {
namespace {

TrackedView tracked(const Photograph& photograph, const PyramidWorkspace& pyramid) {
  return {build_pyramid(view_of(photograph.gray), pyramid), view_of(photograph.labels), photograph.view.lens};
}

}  // namespace

Status SparseStages::run(const std::array<Photograph, 2>& photographs, const std::array<CardPrior, 2>& cards,
                         const Vec3& card_middle_mm, std::uint64_t seed) {
  Random random(seed);
  PointTrackingReport report;
  const Status status =
      track_points(tracked(photographs[0], *first_pyramid_), tracked(photographs[1], *second_pyramid_),
                   {cards[0].camera_from_table, cards[1].camera_from_table}, card_middle_mm.z(), tracking_,
                   random, *tracking_space_, tracks_, report);
  if (!status.ok()) return status;
  BundleInput input;
  input.cards = cards;
  input.card_middle_mm = card_middle_mm;
  input.tracks = tracks_;
  for (std::size_t v = 0; v < 2; ++v) input.focals_px[v] = photographs[v].view.lens.pinhole.mean_focal_px();
  return adjust_bundle(input, {}, *joint_space_, joint_);
}

PoseDeviation compare_motion(const TableCameras& found, const TableCameras& truth) {
  const Pose motion = second_from_first(found);
  const Pose true_motion = second_from_first(truth);
  return {rotation_error_deg(motion, true_motion), direction_error_deg(motion, true_motion),
          100.0 * (motion.translation.norm() / true_motion.translation.norm() - 1.0)};
}

double median_epipolar_px(std::span<const RayMatch> matches, const TableCameras& cameras, double focal_px) {
  const EpipolarDistance distance(second_from_first(cameras), focal_px);
  std::vector<double> distances_px;
  for (const RayMatch& match : matches) distances_px.push_back(std::abs(distance(match.first, match.second)));
  const auto middle = distances_px.begin() + static_cast<std::ptrdiff_t>(distances_px.size() / 2);
  std::nth_element(distances_px.begin(), middle, distances_px.end());
  return *middle;
}

}  // namespace traygauge::test
