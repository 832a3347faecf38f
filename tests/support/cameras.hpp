// Where cameras of tests stand, and what lens they have.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge::test {

// World to camera: at `position`, its axis through `target`, rolled about it.
inline Pose looking_at(const Vec3& position, const Vec3& target, double roll_rad) {
  const Vec3 forward = (target - position).normalized();
  const Vec3 hint = std::abs(forward.y()) < 0.9 ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 right = forward.cross(hint).normalized();
  Mat3 rotation;
  rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  rotation = Eigen::AngleAxisd(roll_rad, Vec3::UnitZ()) * rotation;
  return {rotation, -(rotation * position)};
}

// World to camera: `distance_mm` from the origin, looking at it, `tilt_rad` off the vertical towards
// `azimuth_rad`; z of the world points up.
inline Pose camera_above(double tilt_rad, double azimuth_rad, double distance_mm) {
  const Vec3 forward = -Vec3(std::sin(tilt_rad) * std::cos(azimuth_rad),
                             std::sin(tilt_rad) * std::sin(azimuth_rad), std::cos(tilt_rad));
  const Vec3 right = Vec3(-std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0);
  Mat3 rotation;
  rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return {rotation, Vec3(0.0, 0.0, distance_mm)};
}

// Turned and shifted by so much, in random directions.
inline Pose perturbed(const Pose& pose, double turn_deg, double shift_mm, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Vec3 axis = Vec3(normal(random), normal(random), normal(random)).normalized();
  const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
  return Pose{rotation_about(axis * turn_deg * std::numbers::pi / 180.0), direction * shift_mm} * pose;
}

inline double rotation_error_deg(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(Mat3(a.rotation.transpose() * b.rotation)).angle() * 180.0 / std::numbers::pi;
}

// Between the translations.
inline double direction_error_deg(const Pose& a, const Pose& b) {
  const Vec3 u = a.translation.normalized();
  const Vec3 v = b.translation.normalized();
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi;
}

// As phones have them: 1600 × 1200 pixels times `scale`.
inline LensModel phone_lens(double scale = 1.0) {
  LensModel lens;
  lens.width = static_cast<int>(std::lround(1600.0 * scale));
  lens.height = static_cast<int>(std::lround(1200.0 * scale));
  lens.pinhole = {1388.4 * scale, 1391.0 * scale, 806.3 * scale, 594.8 * scale};
  lens.k1 = -0.082;
  lens.k2 = 0.021;
  lens.p1 = 0.0006;
  lens.p2 = -0.0004;
  lens.k3 = -0.003;
  return lens;
}

}  // namespace traygauge::test
