// A search for the motion between two views in the place of ours, for comparisons with other fitters.
#pragma once

#include <span>

#include "core/base/random.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"

namespace traygauge::paper {

class MotionSearch {
 public:
  // The motion that explains the matches, its translation of any length; false when none was found.
  virtual bool find_motion(std::span<const RayMatch> matches, double focal_px, Random& random,
                           Pose& second_from_first) = 0;

 protected:
  ~MotionSearch() = default;
};

}  // namespace traygauge::paper
