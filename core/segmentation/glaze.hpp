// What a dish's glaze looks like: the flange shows it.
#pragma once

#include <cmath>

#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"

namespace traygauge {

struct GlazeParams {
  double min_share_sigma = 4.0;  // of the colour shares, 1/255: noise and compression
  int texture_radius = 2;        // cells
  int min_flange_cells = 100;
};

// The colour of the flange; deviations by the median of absolute differences.
struct GlazeColour {
  CellColour median;
  double share_sigma = 0.0;
  double texture = 0.0;  // median of the mean bends about its cells, doubled
};

// False with too few cells of the flange.
bool measure_glaze(const DishRaster& raster, const GlazeParams& params, GlazeColour& glaze);

// How much luma bends from cell to cell along both axes: slopes, as on a shaded wall, have none. 0 at the
// raster's border.
inline int bend_at(const ImageView<const CellColour>& colours, int x, int y) {
  if (x == 0 || y == 0 || x + 1 == colours.width || y + 1 == colours.height) return 0;
  const CellColour* cell = colours.row(y) + x;
  return std::abs(2 * cell->luma - cell[-1].luma - cell[1].luma) +
         std::abs(2 * cell->luma - cell[-colours.stride].luma - cell[colours.stride].luma);
}

}  // namespace traygauge
