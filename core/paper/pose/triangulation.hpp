// Points in space from matches and the motion between the views.
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/paper/pose/ray_match.hpp"

namespace traygauge {

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
