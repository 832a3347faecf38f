// How far one description of a dish is from another.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/dish/dish_profile.hpp"

namespace traygauge::test {

struct ProfileDifference {
  double worst_mm = 0.0;
  double volume_ml = 0.0;  // of the space between both, over the dish
};

// `found` against `truth` as they lie upon each other where the dish stands, from `begin_mm` inside the edge
// to the middle.
inline ProfileDifference compare_profiles(const DishModel& found, const DishModel& truth, double begin_mm) {
  constexpr double kStepMm = 0.5;
  constexpr double kMm3PerMl = 1000.0;
  DishProfile a;
  DishProfile b;
  ProfileDifference difference;
  if (!a.set(found).ok() || !b.set(truth).ok()) return {INFINITY, INFINITY};
  const Vec2 reach = b.semi_axes_mm();
  for (double y = -reach.y(); y < reach.y(); y += kStepMm) {
    for (double x = -reach.x(); x < reach.x(); x += kStepMm) {
      const Vec2 at(x, y);
      if (at.cwiseQuotient(reach).norm() >= 1.0 || b.inset_mm(at) < begin_mm) continue;
      const double off_mm = a.height_mm(at) - b.height_mm(at);
      difference.worst_mm = std::max(difference.worst_mm, std::abs(off_mm));
      difference.volume_ml += off_mm * kStepMm * kStepMm / kMm3PerMl;
    }
  }
  return difference;
}

}  // namespace traygauge::test
