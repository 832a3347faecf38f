// The frame in which the product measures: mm, origin on the table under the top left corner of the card's
// print, x along the print's upper edge, y against its rows, z up from the table. Heights are z.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/geometry/geometry.hpp"

namespace traygauge {

// Where a point of the print lies; `pattern_mm` counts from the print's top left corner, right and down.
inline Vec3 print_point_mm(const Vec2& pattern_mm, double thickness_mm) {
  return {pattern_mm.x(), -pattern_mm.y(), thickness_mm};
}

// Both cameras of a pair, camera_from_table, in mm.
using TableCameras = std::array<Pose, 2>;

inline Pose second_from_first(const TableCameras& camera_from_table) {
  return camera_from_table[1] * camera_from_table[0].inverse();
}

// The camera's centre in the table frame.
inline Vec3 camera_centre_mm(const Pose& camera_from_table) {
  return -(camera_from_table.rotation.transpose() * camera_from_table.translation);
}

// Between the lines of sight to a point of the table frame.
inline double angle_between_views_deg(const TableCameras& camera_from_table, const Vec3& point_mm) {
  const Vec3 first = (camera_centre_mm(camera_from_table[0]) - point_mm).normalized();
  const Vec3 second = (camera_centre_mm(camera_from_table[1]) - point_mm).normalized();
  return std::acos(std::clamp(first.dot(second), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

// A step of a pose, and its information or covariance.
using Vec6 = Eigen::Matrix<double, kPoseParameters, 1>;
using Mat6 = Eigen::Matrix<double, kPoseParameters, kPoseParameters>;
// A step of the first camera, then one of the second.
inline constexpr int kCameraParameters = 2 * kPoseParameters;
using CamerasMatrix = Eigen::Matrix<double, kCameraParameters, kCameraParameters>;

// A step of six parameters, turn (radians) and shift (mm): every refinement moves a pose this way, so that
// their information matrices can be added.
inline Pose moved(const Pose& pose, const Vec6& step) {
  return {rotation_about(step.head<3>()) * pose.rotation, pose.translation + step.tail<3>()};
}

// The step that leads from one pose to another nearby. Turns are taken for small: half the antisymmetric part
// of a rotation is its axis times the sine.
inline Vec6 step_between(const Pose& from, const Pose& to) {
  const Mat3 turn = to.rotation * from.rotation.transpose();
  Vec6 step;
  step << 0.5 * (turn(2, 1) - turn(1, 2)), 0.5 * (turn(0, 2) - turn(2, 0)), 0.5 * (turn(1, 0) - turn(0, 1)),
      to.translation - from.translation;
  return step;
}

}  // namespace traygauge
