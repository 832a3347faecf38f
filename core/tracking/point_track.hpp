// A point of the scene, found in both views to a fraction of a pixel.
#pragma once

#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"

namespace traygauge {

inline constexpr int kMinTracks = 20;  // fewer support no pose and contradict none

struct PointTrack {
  Vec2 first = Vec2::Zero();  // rays (z = 1), undistorted
  Vec2 second = Vec2::Zero();
  float sigma_px = 0.1F;   // standard deviation of its place in the second stored picture, per axis
  std::uint8_t label = 0;  // where it lies in the first view
};

// Where both its rays meet nearest, in the table frame. False where they are parallel or meet behind a
// camera.
inline bool triangulate_track(const PointTrack& track, const Pose& first_from_table,
                              const Pose& second_from_first, Vec3& point_mm) {
  const Vec3 ray = track.first.homogeneous();
  double depth_mm = 0.0;
  if (!triangulate_depth(second_from_first.rotation * ray, track.second.homogeneous(),
                         second_from_first.translation, depth_mm))
    return false;
  point_mm = first_from_table.inverse() * (depth_mm * ray);
  return true;
}

}  // namespace traygauge
