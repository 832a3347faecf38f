// The outer edge of a dish that nothing is known of, from its outlines in both views.
#pragma once

#include "core/base/status.hpp"
#include "core/dish/dish_pose.hpp"

namespace traygauge {

struct DishEdgeParams {
  // Levels over the table on which the outlines are laid: on the edge's own both give the same ellipse.
  double lowest_mm = 3.0;
  double highest_mm = 150.0;
  double level_step_mm = 3.0;
  // Axes that differ by less are a round dish's: firing bends plates by some tenths of a mm.
  double round_mm = 1.0;
};

// Size, height and place of the edge at given cameras. rim_not_found: too few points, or they lie on no
// ellipse; labels_inconsistent: no level has both outlines.
Status measure_dish_edge(const DishOutlines& outlines, const TableCameras& cameras, const FocalsPx& focals_px,
                         const DishPoseParams& placement, const DishEdgeParams& params,
                         DishPoseWorkspace& workspace, DishPose& place);

}  // namespace traygauge
