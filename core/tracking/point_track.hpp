// A point of the scene, found in both views to a fraction of a pixel.
#pragma once

#include <cstdint>

#include "core/geometry/geometry.hpp"

namespace traygauge {

inline constexpr int kMinTracks = 20;  // fewer support no pose and contradict none

struct PointTrack {
  Vec2 first = Vec2::Zero();  // rays (z = 1), undistorted
  Vec2 second = Vec2::Zero();
  float sigma_px = 0.1F;   // standard deviation of its place in the second stored picture, per axis
  std::uint8_t label = 0;  // where it lies in the first view
};

}  // namespace traygauge
