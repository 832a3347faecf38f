// The dish's inner surface where the dish stands: what lies under the food.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/base/status.hpp"
#include "core/dish/dish_model.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

// Where a dish stands in the table frame; it stands upright.
struct DishFrame {
  Vec2 centre_mm = Vec2::Zero();
  Vec2 axis = Vec2::UnitX();  // unit, along outer_size_mm[0]
};

// Height of the inner surface above the table: a monotone piecewise cubic over the inset from the outer edge.
// F. N. Fritsch, J. Butland, A method for constructing local monotone piecewise cubic interpolants, SIAM J.
// Sci. Stat. Comput. 5 (1984); end slopes by the three-point formula of C. Moler, Numerical Computing with
// MATLAB (2004), 3.4, as in SciPy's PchipInterpolator. Beyond the last point the bottom is flat.
class DishProfile {
 public:
  // invalid_configuration when the insets do not increase from 0 up to less than half of the dish's smaller
  // size, or when a number is not finite.
  Status set(const DishModel& model);

  // Height over the table at a point of the dish's own frame (centre, axes). Outside of the edge, the edge's.
  double height_mm(const Vec2& dish_mm) const {
    const double inset = inset_mm(dish_mm);
    return inset >= last_inset_mm_ ? bottom_height_mm_ : height_at_inset_mm(inset);
  }

  // Inset d of the curve (x/(a−d))² + (y/(b−d))² = 1 through the point; negative outside of the edge. Points
  // over the flat bottom all get its inset: 0 in a dish without a profile.
  double inset_mm(const Vec2& dish_mm) const;

  // Insets off the profile take its end values.
  double height_at_inset_mm(double inset_mm) const;

  // Greatest height of the inner surface: the rim's crest.
  double crest_height_mm() const { return crest_height_mm_; }
  double bottom_height_mm() const { return bottom_height_mm_; }
  const Vec2& semi_axes_mm() const { return semi_axes_mm_; }

 private:
  struct Knot {
    double inset_mm = 0.0;
    double height_mm = 0.0;
    double slope = 0.0;
  };

  void set_slopes();

  std::array<Knot, kMaxDishProfilePoints> knots_{};
  std::size_t size_ = 0;
  Vec2 semi_axes_mm_ = Vec2::Zero();
  double last_inset_mm_ = 0.0;
  double bottom_height_mm_ = 0.0;
  double crest_height_mm_ = 0.0;
};

// A dish's inner surface in the table frame.
struct InnerSurface {
  DishProfile profile;
  DishFrame place;

  Vec2 to_dish(const Vec2& table_mm) const { return turned_back_by(table_mm - place.centre_mm, place.axis); }
  double height_mm(const Vec2& table_mm) const { return profile.height_mm(to_dish(table_mm)); }
};

}  // namespace traygauge
