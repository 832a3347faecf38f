// Points, motions and planes. Camera axes as in OpenCV: x right, y down, z forward.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace traygauge {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

// A step of a pose: turn (3), shift (3).
inline constexpr int kPoseParameters = 2 * Vec3::SizeAtCompileTime;

// A rigid motion between two frames, named target_from_source: x_target = rotation * x_source + translation.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();

  Vec3 operator*(const Vec3& point) const { return rotation * point + translation; }
  // This motion after `first`: c_from_a = c_from_b * b_from_a.
  Pose operator*(const Pose& first) const { return {rotation * first.rotation, *this * first.translation}; }
  Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
};

// Signed height of a point: normal · point − offset; `normal` has unit length and points up, to the camera.
struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0.0;

  double height(const Vec3& point) const { return normal.dot(point) - offset; }
  // The parallel plane `distance` higher.
  Plane raised(double distance) const { return {normal, offset + distance}; }
};

// The plane through `point` with this unit normal, or its opposite, so that the camera (the origin) lies
// above.
inline Plane plane_towards_camera(const Vec3& normal, const Vec3& point) {
  const double offset = normal.dot(point);
  return offset > 0.0 ? Plane{-normal, -offset} : Plane{normal, offset};
}

// Of numbers about 1: a hundred times what a hundred roundings of doubles (2^-53 each) add up to at most.
inline constexpr double kRounding = 1e-12;

// Of weighing anew, and of fixed points, where the second or third round changes next to nothing.
inline constexpr int kSettlingRounds = 4;

// Of Newton's and like iterations, which end by themselves after 3 to 14 steps.
inline constexpr int kMaxNewtonSteps = 20;

// Nearer to a camera than this nothing is seen, and views from nearer to each other are one.
inline constexpr double kNearMm = 1.0;

// The rotation by |turn| radians about the axis `turn`.
inline Mat3 rotation_about(const Vec3& turn) {
  const double angle = turn.norm();
  if (!(angle > 0.0)) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

// By how much a rotation turns, whichever way.
inline double rotation_angle_deg(const Mat3& rotation) {
  return 180.0 / std::numbers::pi * std::abs(Eigen::AngleAxisd(rotation).angle());
}

// The third coordinate of the cross product: positive where b lies left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// A turn in the plane is a unit vector, its cosine and sine; the products are those of complex numbers.
inline Vec2 turned_by(const Vec2& v, const Vec2& turn) {
  return {turn.x() * v.x() - turn.y() * v.y(), turn.y() * v.x() + turn.x() * v.y()};
}

// Undoes turned_by. Also the turn that leads from the direction `turn` to the direction `v`.
inline Vec2 turned_back_by(const Vec2& v, const Vec2& turn) {
  return {turn.x() * v.x() + turn.y() * v.y(), turn.x() * v.y() - turn.y() * v.x()};
}

inline Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

// Essential matrix of second_from_first: x2ᵀ E x1 = 0 for rays x1, x2 (Hartley & Zisserman 9.12).
inline Mat3 essential_matrix(const Pose& second_from_first) {
  return skew(second_from_first.translation) * second_from_first.rotation;
}

}  // namespace traygauge
