// Where two rays of a calibrated pair meet (paper III-B-3).
#pragma once

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

}  // namespace traygauge
