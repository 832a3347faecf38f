// What an error of the lens does to a volume: a meal of known shape, seen by one lens and measured with
// another.
#pragma once

#include <optional>

#include "core/geometry/camera.hpp"

namespace traygauge {

// Two views as a station takes them, of a heap of food on a table with the card beside it.
struct StandardMealParams {
  double view_width_mm = 560.0;    // of the table across the picture: a tray's longer side with some margin
  double first_tilt_deg = 5.0;     // of the line of sight against the vertical
  double second_view_deg = 18.0;   // from there
  double radius_mm = 90.0;         // of the heap
  double height_mm = 30.0;         // of its middle over the table; it falls like a paraboloid
  double grid_mm = 15.0;           // between the points that are matched
  double table_radius_mm = 125.0;  // around the heap, where the table is seen
  double card_from_middle_mm = 165.0;  // to the card's middle
};

// The volume by `assumed` over the true one, minus 1, where the pictures come through `actual`: the cameras
// and the table are found from the matched points and the card, as profile best does, and the food is
// triangulated. Nothing when no cameras explain the points.
std::optional<double> volume_deviation(const LensModel& actual, const LensModel& assumed,
                                       const StandardMealParams& params);

}  // namespace traygauge
