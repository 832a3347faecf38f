// Points in space from corresponding rays of two views and the motion between them.
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

// Both working pictures and the metric motion between them.
struct CameraPair {
  PinholeCamera first;
  PinholeCamera second;
  Pose second_from_first;  // mm
};

// Depth along the first ray (scaled to z = 1) of its point nearest to the second ray. `first_in_second` is
// the first ray rotated into the second camera. From z (R x1) × x2 + t × x2 = 0 in the least-squares sense,
// which minimises the distance to the second ray; a match off its epipolar line changes z in second order
// only. False where the rays are parallel or meet behind a camera.
inline bool triangulate_depth(const Vec3& first_in_second, const Vec3& second, const Vec3& translation,
                              double& depth) {
  const Vec3 direction = first_in_second.cross(second);
  const double squared_sine = direction.squaredNorm();
  if (!(squared_sine > 0.0)) return false;
  depth = -translation.cross(second).dot(direction) / squared_sine;
  return depth > 0.0 && depth * first_in_second.z() + translation.z() > 0.0;
}

// Corresponding rays (normalised, undistorted image points) of the two views.
struct RayMatch {
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
};

// Distances along the rays (as depths along the optical axes) at which two rays pass closest to a common
// point.
struct RayDepths {
  double first = 0.0;
  double second = 0.0;
};

// False when the rays are parallel.
bool intersect_rays(const RayMatch& match, const Pose& second_from_first, RayDepths& depths);

// The match moved by the smallest change of both image points (least sum of squares) onto the epipolar
// geometry: Lindstrom 2010, two iterations.
RayMatch correct_match(const RayMatch& match, const Pose& second_from_first);

// The optimal point of correct_match, in the first camera's axes and the unit of the translation. False for
// parallel rays or a point behind either camera.
bool triangulate(const RayMatch& match, const Pose& second_from_first, Vec3& point_in_first);

// The sparse cloud (end of paper III-A-2). Points and flags belong to the matches of the same index; matches
// whose `inliers` is 0 are left out. All spans have the same length.
void triangulate_all(std::span<const RayMatch> matches, std::span<const std::uint8_t> inliers,
                     const Pose& second_from_first, std::span<Vec3> points_in_first,
                     std::span<std::uint8_t> triangulated);

// Angle between the rays of a match once the rotation is compensated.
double parallax_angle_rad(const RayMatch& match, const Mat3& rotation);

}  // namespace traygauge
