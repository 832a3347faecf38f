// A dish as a solid: the inner surface that its description states, and porcelain below.
#pragma once

#include "simulator/capture/dish_description.hpp"
#include "simulator/render/mesh.hpp"
#include "simulator/scenes/monotone_cubic.hpp"

namespace traygauge {

// Coordinates of the dish: origin under its middle on what it stands on, x along outer_size_mm[0], z up.
class DishShell {
 public:
  explicit DishShell(const DishDescription& dish);

  // How far inside the outer edge: d of (x/(a-d))^2 + (y/(b-d))^2 = 1, no more than where the flat bottom
  // begins; negative outside.
  double inset_mm(double x_mm, double y_mm) const;
  // Of the inner surface; outside of the edge that of the edge.
  double inner_height_mm(double x_mm, double y_mm) const;
  bool contains(double x_mm, double y_mm, double margin_mm) const;

  double semi_axis_mm(int axis) const { return axis == 0 ? semi_x_mm_ : semi_y_mm_; }
  double bottom_height_mm() const { return bottom_height_mm_; }
  double rim_height_mm() const { return rim_height_mm_; }
  double flat_inset_mm() const { return flat_inset_mm_; }  // where the flat bottom begins

  // Closed, with the outer wall and a foot.
  TriangleMesh mesh() const;

 private:
  double semi_x_mm_;
  double semi_y_mm_;
  double bottom_height_mm_;
  double rim_height_mm_;
  double flat_inset_mm_;
  MonotoneCubic height_mm_;
};

}  // namespace traygauge
