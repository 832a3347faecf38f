// Food that its height alone tells. A network takes food unlike any that it learned for glaze without a
// doubt, and where that has the glaze's colour nothing else speaks for it.
#pragma once

#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/segmentation/components.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/height_sample.hpp"

namespace traygauge {

// Chosen on 95 dishes, of the development sets of tests/evaluation/labels.md and of the captures: whichever
// of their 222 items is left out, these squares find 96 % of them again, and nothing else.
struct StandingFoodParams {
  double radius_mm = 5.0;    // of a square; reflections and edges that seem to stand are narrower
  double least_lift = 0.25;  // from which a cell stands
  double least_share = 0.9;  // of a square's cells
};

struct StandingFoodWorkspace {
  std::span<std::uint8_t> row_sums;     // for every cell
  std::span<std::int32_t> column_sums;  // for every column
  std::span<std::int32_t> queue;        // for every cell
};

inline constexpr std::uint8_t kStandingFood = kVisited + 2;  // no label of a dish or item

// Makes kStandingFood of kGlazeSeed on squares that stand above the dish, where the middles of such squares
// cover at least `min_mm2` in one piece. Returns whether there are any.
bool add_standing_food(const DishRaster& raster, ImageView<const HeightSample> relief,
                       const HeightWeightParams& weights, const StandingFoodParams& params, double min_mm2,
                       const StandingFoodWorkspace& workspace, ImageView<std::uint8_t> cells);

}  // namespace traygauge
