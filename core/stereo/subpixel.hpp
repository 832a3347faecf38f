// The disparity between whole pixels, from the costs beside the best one.
#pragma once

#include "core/stereo/disparity.hpp"

namespace traygauge {

// Vertex of the parabola through three costs, in sixteenths of a pixel: −8 … 8. 0 where the middle is not
// lowest.
int parabola_offset(int before, int middle, int after);

}  // namespace traygauge
