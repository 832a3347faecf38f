// What lies where no view sees: the cells of a height map that only bounds reach.
#pragma once

#include <span>

#include "core/volume/height_map.hpp"

namespace traygauge {

// Fills unseen cells within reach of others, then hidden cells: there the item whose edge hides the cell goes
// on from that edge, tangent to the line of sight and bending down evenly, so that on the whole it falls
// hidden_steepness times as fast as its flanks that are seen and steeper than `steepest_sight` (rise over
// run); no lower than what is seen at the foot of the line of sight goes on level, nor than the dish.
void fill_occluded_cells(const InnerSurface& dish, const HeightMapParams& params, double steepest_sight,
                         std::span<HeightMapWorkspace::Source> sources, HeightMap& map);

}  // namespace traygauge
