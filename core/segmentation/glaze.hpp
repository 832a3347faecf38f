// Which cells show the dish's glaze for sure, which food, by colour and texture: the flange says what the
// glaze looks like.
#pragma once

#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"

namespace traygauge {

// Labels of the seeds for spread_owners.
inline constexpr std::uint8_t kGlazeSeed = 1;
inline constexpr std::uint8_t kFoodSeed = 2;

struct GlazeParams {
  double min_share_sigma = 4.0;  // of the colour shares, 1/255: noise and compression
  // In those deviations from the flange's median, for a cell to be glaze for sure, and food for sure.
  double glaze_deviations = 2.0;
  double food_deviations = 8.0;
  double textured_food_deviations = 2.5;  // with more texture than glaze has
  // Light on the glaze, over the flange's: shadows, the steep wall and highlights lie between.
  double darkest = 0.72;
  double brightest = 1.18;
  double food_darkest = 0.45;  // darker is not a shadow
  int texture_radius = 2;      // cells
  double texture_ratio = 2.2;  // of the local deviation of luma over the flange's, for sure glaze at most
  double food_texture_ratio = 3.0;
  int min_flange_cells = 100;
};

// The colour of the flange; deviations by the median of absolute differences.
struct GlazeColour {
  CellColour median;
  double share_sigma = 0.0;
  double texture = 0.0;  // median local deviation of luma
};

// How much luma bends from cell to cell, doubled and averaged over a square, for every cell: slopes, as on a
// shaded wall, have none. O(cells).
void measure_texture(const DishRaster& raster, int radius, std::span<std::int32_t> column_sums,
                     ImageView<std::uint16_t> texture);

// False with too few cells of the flange.
bool measure_glaze(const DishRaster& raster, ImageView<const std::uint16_t> texture,
                   const GlazeParams& params, GlazeColour& glaze);

// Seeds: kGlazeSeed, kFoodSeed, kNoOwner where neither is sure, kBarred outside of the dish.
void seed_food(const DishRaster& raster, ImageView<const std::uint16_t> texture, const GlazeColour& glaze,
               const GlazeParams& params, ImageView<std::uint8_t> seeds);

}  // namespace traygauge
