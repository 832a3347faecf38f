#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/paper/pipeline/estimator_state.hpp"
#include "core/paper/pipeline/label_agreement.hpp"
#include "core/quality/view_input.hpp"

namespace traygauge::paper {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Unit vectors from the dish to both cameras, in the first camera's axes.
struct LinesOfSight {
  Vec3 first;
  Vec3 second;

  double angle_deg() const { return kDegrees * std::acos(std::clamp(first.dot(second), -1.0, 1.0)); }
};

// Where the ray from a camera through the middle of its picture of the dish meets the table.
Vec3 fit_dish_pose(const PreparedView& view, const Pose& first_from_view, const Plane& table) {
  const Vec2 middle = view.dish.camera.ray(Vec2(0.5 * view.dish.width, 0.5 * view.dish.height));
  const Vec3 direction = first_from_view.rotation * middle.homogeneous();
  return first_from_view.translation -
         direction * (table.height(first_from_view.translation) / table.normal.dot(direction));
}

// The dish stands between the places that both views give it, each right to a few centimetres; the mean
// serves both orders of the views alike.
LinesOfSight look_from_dish(const PreparedView& first, const PreparedView& second,
                            const Extrinsics& extrinsics) {
  const Pose first_from_second = extrinsics.second_from_first.inverse();
  const Vec3 dish = 0.5 * (fit_dish_pose(first, Pose{}, extrinsics.table) +
                           fit_dish_pose(second, first_from_second, extrinsics.table));
  return {(-dish).normalized(), (first_from_second.translation - dish).normalized()};
}

Plane in_other_camera(const Plane& plane, const Pose& other_from_this) {
  const Vec3 normal = other_from_this.rotation * plane.normal;
  return {normal, plane.offset + normal.dot(other_from_this.translation)};
}

// The paper's reference is the first view. Ours is the one nearer to the vertical, whichever was taken first:
// it sees less of the steep flanks at a slant, and a pair measures the same in either order.
ReferencePair choose_reference(EstimatorState& state, const LinesOfSight& lines, TableReference& table,
                               MeasurementViews& views) {
  Extrinsics& extrinsics = state.extrinsics;
  const Plane& plane = extrinsics.table;
  const bool keep = lines.first.dot(plane.normal) >= lines.second.dot(plane.normal);
  table = {plane, extrinsics.card_points.items()};
  views.reference_view = state.worked_index(keep ? 0 : 1);
  if (keep)
    return {&state.worked_view(0), &state.worked_view(1), extrinsics.second_from_first,
            extrinsics.inliers.items()};

  table.table = in_other_camera(plane, extrinsics.second_from_first);
  for (Vec3& point : extrinsics.card_points.items()) point = extrinsics.second_from_first * point;
  for (RayMatch& match : extrinsics.inliers.items()) std::swap(match.first, match.second);
  return {&state.worked_view(1), &state.worked_view(0), extrinsics.second_from_first.inverse(),
          extrinsics.inliers.items()};
}

void show_pictures(EstimatorState& state) {
  state.pictures = {};
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    state.pictures.cameras[k] = state.view(i).cutout.camera;
    state.pictures.gray[k] = state.view(i).gray;
    state.pictures.labels[k] = state.view(i).working_labels;
  }
}

void warn_about_views(const EstimatorState& state, Measurement& measurement) {
  const Extrinsics& extrinsics = state.extrinsics;
  const auto& views = state.memory.views;
  const double min_kept_fraction = state.configuration.view.min_kept_keypoint_fraction;
  const auto is_crowded = [&](const PreparedView& view) {
    return static_cast<double>(view.keypoints.size()) <
           min_kept_fraction * static_cast<double>(view.keypoints_found);
  };
  WarningSet& warnings = measurement.warnings;
  warnings.raise_if(is_crowded(views[0]) || is_crowded(views[1]), Warning::keypoints_capped);
  warnings.raise_if(extrinsics.matches_capped, Warning::matches_capped);
  warnings.raise_if(extrinsics.pose_from_card, Warning::pose_from_card);
  warnings.raise_if(measurement.report.card_tracks < state.configuration.card_search.few_tracks,
                    Warning::few_card_points);
  warn_about_angles({measurement.relative_angle_deg, measurement.rotation_angle_deg, views[0].arm_angle_deg,
                     views[1].arm_angle_deg},
                    state.configuration.geometry, warnings);
}

Status calibrate(EstimatorState& state, Random& random, StageClock& clock, Measurement& measurement) {
  const PatternMemory& pattern = state.memory.pattern;
  const std::size_t pattern_count = pattern.keypoints.size();
  const ExtrinsicInput input{&state.worked_view(0),
                             &state.worked_view(1),
                             {pattern.keypoints.items(), pattern.descriptors.first(pattern_count)},
                             pattern.positions_mm.first(pattern_count),
                             &state.memory.given,
                             state.motion_search};
  const Status status = calibrate_extrinsics(input, state.configuration, random, state.memory.calibration,
                                             clock, measurement.report, state.extrinsics);
  if (!status.ok()) return status;
  measurement.has_pose = true;
  const Pose& motion = state.extrinsics.second_from_first;
  measurement.second_from_first = state.works_in_reverse() ? motion.inverse() : motion;
  measurement.rotation_angle_deg = rotation_angle_deg(measurement.second_from_first.rotation);
  return StatusCode::ok;
}

Status measure_views(EstimatorState& state, std::uint64_t seed, StageClock& clock, Measurement& measurement) {
  const auto& prepared = state.memory.views;
  const Status pictures =
      compare_pictures(prepared[0].quality(), prepared[1].quality(), state.configuration.view_checks,
                       measurement.report.pictures, measurement.warnings);
  if (!pictures.ok()) return pictures;
  Random random(seed);
  if (const Status status = calibrate(state, random, clock, measurement); !status.ok()) return status;
  const LinesOfSight lines = look_from_dish(state.worked_view(0), state.worked_view(1), state.extrinsics);
  measurement.relative_angle_deg = lines.angle_deg();
  warn_about_views(state, measurement);
  if (const Status status = check_angle(measurement.relative_angle_deg, state.configuration.geometry);
      !status.ok()) {
    return status;
  }

  TableReference table;
  MeasurementViews& views = measurement.views;
  const ReferencePair pair = choose_reference(state, lines, table, views);
  DenseWorkspace& dense = state.memory.dense;
  Status status =
      reconstruct_dense(pair, state.configuration, dense, clock, measurement.report, state.pictures);
  if (!status.ok()) return status;
  const LabelAgreementParams& agreement = state.configuration.label_agreement;
  measurement.report.label_agreement =
      measure_label_agreement(pair.reference->working_labels, pair.other->working_labels,
                              state.pictures.depth_mm, pair.cameras(), agreement);
  if (measurement.report.label_agreement < agreement.min_fraction) return StatusCode::labels_inconsistent;
  status = find_dish_bottom(pair, table, state.configuration, random, state.memory.extraction,
                            measurement.report, state.pictures, views);
  if (!status.ok()) return status;
  measurement.warnings.raise_if(state.configuration.dishes.size() > 1, Warning::dish_guessed, kDishLabel);
  return extract_volumes(pair, state.configuration, state.memory.extraction, clock, state.pictures, views);
}

void report_keypoints(const EstimatorState& state, MeasurementReport& report) {
  for (std::size_t i = 0; i < 2; ++i) {
    report.keypoints[i] = static_cast<int>(state.memory.views[i].keypoints.size());
    report.keypoints_found[i] = static_cast<int>(state.memory.views[i].keypoints_found);
  }
}

Status check_views(const EstimatorState& state) {
  if (state.views > 0 && !state.views_status.ok()) return state.views_status;
  return state.views == 2 ? StatusCode::ok : StatusCode::frame_missing;
}

}  // namespace

void run_measurement(EstimatorState& state, std::uint64_t seed, StageClock& clock, Measurement& measurement) {
  report_keypoints(state, measurement.report);
  measurement.status = check_views(state);
  if (!measurement.status.ok()) return;
  state.memory.extraction.items.clear();
  show_pictures(state);
  measurement.status = measure_views(state, seed, clock, measurement);
  measurement.items = state.memory.extraction.items.items();
}

}  // namespace traygauge::paper
