// What a dish's glaze looks like: the flange shows it.
#pragma once

#include "core/segmentation/dish_raster.hpp"

namespace traygauge {

struct GlazeParams {
  double min_share_sigma = 4.0;  // of the colour shares, 1/255: noise and compression
  int min_flange_cells = 100;
};

// Shares of red and green, as a cell's colour has them: the flange's medians, and their deviations by the
// median of absolute differences.
struct GlazeColour {
  int red = 0;
  int green = 0;
  double share_sigma = 0.0;
};

// False with too few cells of the flange.
bool measure_glaze(const DishRaster& raster, const GlazeParams& params, GlazeColour& glaze);

}  // namespace traygauge
