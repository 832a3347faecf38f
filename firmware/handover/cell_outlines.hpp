// Outlines of what has a label on a grid of cells.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/volume/height_map.hpp"

namespace traygauge {

// Closed: the last point is joined to the first. mm in the table frame, the label to the left of the way.
using Outline = std::vector<Vec2>;

// Around every piece of the label, and around its holes, within `tolerance_mm` of the cells' borders. Specks
// of a few cells have none.
std::vector<Outline> outline_label(const HeightMap& map, std::uint8_t label, double tolerance_mm);

}  // namespace traygauge
