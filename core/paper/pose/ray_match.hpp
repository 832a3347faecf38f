// A point match as two viewing rays.
#pragma once

#include "core/geometry/geometry.hpp"

namespace traygauge {

// Corresponding rays (normalised, undistorted image points) of the two views.
struct RayMatch {
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
};

}  // namespace traygauge
