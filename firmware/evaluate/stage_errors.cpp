#include "firmware/evaluate/stage_errors.hpp"

#include <cmath>
#include <numbers>

namespace traygauge {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

double angle_deg(const Vec3& a, const Vec3& b) {
  return kDegrees * std::atan2(a.cross(b).norm(), a.dot(b));
}

// Height error of `plane` (camera coordinates) against the world's plane z = height, over the world's origin,
// along the world's vertical.
double offset_mm(const Plane& plane, const Pose& camera_from_world, double height_mm) {
  const Vec3 centre = camera_from_world * Vec3(0.0, 0.0, height_mm);
  const Vec3 up = camera_from_world.rotation.col(2);
  return -plane.height(centre) / plane.normal.dot(up);
}

}  // namespace

Pose PairTruth::second_from_first() const {
  const Pose world_from_first = first_from_world.inverse();
  return {second_from_world.rotation * world_from_first.rotation,
          second_from_world * world_from_first.translation};
}

double PairTruth::relative_angle_deg() const {
  const Vec3 target(0.0, 0.0, bottom_height_mm);
  return angle_deg(first_from_world.inverse().translation - target,
                   second_from_world.inverse().translation - target);
}

StageErrors stage_errors(const Measurement& measurement, const PairTruth& truth) {
  const Pose expected = truth.second_from_first();
  const Pose& found = measurement.second_from_first;
  StageErrors errors;
  errors.rotation_deg = rotation_angle_deg(expected.rotation.transpose() * found.rotation);
  errors.direction_deg = angle_deg(expected.translation, found.translation);
  errors.scale_percent = 100.0 * (found.translation.norm() / expected.translation.norm() - 1.0);

  const Pose& reference =
      measurement.views.reference_view == 0 ? truth.first_from_world : truth.second_from_world;
  const Vec3 up = reference.rotation.col(2);
  errors.bottom_tilt_deg = angle_deg(measurement.views.dish_bottom.normal, up);
  errors.bottom_offset_mm = offset_mm(measurement.views.dish_bottom, reference, truth.bottom_height_mm);
  errors.table_tilt_deg = angle_deg(measurement.views.table.normal, up);
  errors.table_offset_mm = offset_mm(measurement.views.table, reference, 0.0);
  return errors;
}

}  // namespace traygauge
