// Samples that show the dish lie on its inner surface, which is known: plain glaze has nothing to match, and
// what is matched on its shine would stand in front of the food.
#pragma once

#include <span>

#include "core/dish/dish_profile.hpp"
#include "core/stereo/surface_grid.hpp"

namespace traygauge {

// Height over the table at which the line of sight from `eye_mm`, that runs so far over the table for every
// mm it falls, comes down to within 0.02 mm of the dish's height. A line that clips a crest by less than half
// a mm may pass it.
double settled_height_mm(const InnerSurface& dish, const Vec3& eye_mm, const Vec2& run_per_mm);

// Moves the points labelled kDishLabel along their lines of sight down to `dish`. `points` and `evidence` are
// the memory of `grid`'s own.
void project_onto_dish(const InnerSurface& dish, const SurfaceGrid& grid, std::span<SurfacePoint> points,
                       std::span<SurfaceEvidence> evidence);

}  // namespace traygauge
