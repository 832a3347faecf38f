// Volume under the food surface (paper III-C-3): for each triangle its horizontal area times the mean height
// of its corners, summed per label.
#pragma once

#include <cstdint>

namespace traygauge {

struct ItemVolume {
  std::uint8_t label = 0;
  double volume_ml = 0.0;
  double area_mm2 = 0.0;        // horizontal
  double mean_height_mm = 0.0;  // volume / area
  double max_height_mm = 0.0;
};

}  // namespace traygauge
