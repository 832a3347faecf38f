// The rim's size and place, and which dish it belongs to.
#pragma once

#include <array>
#include <span>

#include "core/base/result.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

struct RimEllipse {
  Vec3 centre_mm = Vec3::Zero();
  std::array<Vec3, 2> axes{Vec3::UnitX(), Vec3::UnitY()};  // unit, in the rim plane, long axis first
  std::array<double, 2> size_mm{};                         // whole axes, long one first
};

// The ellipse through rim points in their plane: algebraic least squares about their centre. rim_not_found
// for fewer than five points or when they fit no ellipse.
Result<RimEllipse> fit_rim_size(std::span<const Vec3> rim_points_mm, const Plane& rim);

struct DishCandidate {
  std::array<double, 2> outer_size_mm{};
  double rim_height_mm = 0.0;
};

struct DishChoiceParams {
  // A dish further off in any number is not it. The smallest step between dishes bounds them from above, the
  // rim's rounding, which the border sees up to 2 mm lower, from below.
  double size_tolerance_mm = 12.0;
  double height_tolerance_mm = 6.0;
};

// The candidate nearest in size (either order of axes) and rim height, each measured in its tolerance; −1
// when none lies within them.
int choose_dish(std::span<const DishCandidate> candidates, const std::array<double, 2>& size_mm,
                double rim_height_mm, const DishChoiceParams& params);

}  // namespace traygauge
