// What lies where no view sees: the cells of a height map that only bounds reach.
#pragma once

#include <span>

#include "core/surface/height_map.hpp"

namespace traygauge {

// Fills unseen cells within reach of seen ones, then hidden cells: each continues the nearest item cell that
// is seen, falling as its label's visible flanks do, level where the dish itself hides it.

void fill_hidden_cells(const PlacedDish& dish, const HeightMapParams& params,
                       std::span<const FlankArea> flanks, std::span<HeightMapWorkspace::Source> sources,
                       HeightMap& map);

}  // namespace traygauge
