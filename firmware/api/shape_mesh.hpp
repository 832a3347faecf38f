// A scan's surfaces as a PLY file, which 3-D programs read.
#pragma once

#include <string>

#include "firmware/hub/scan_shape_reader.hpp"

namespace traygauge {

// Binary little-endian PLY: mm in the table frame, z up from the table; a vertex a cell whose height is
// known, with its label (0: bare dish); faces counter-clockwise from above.
std::string compose_shape_mesh(const ReadShape& shape);

}  // namespace traygauge
