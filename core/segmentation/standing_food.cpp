#include "core/segmentation/standing_food.hpp"

#include "core/segmentation/geodesic.hpp"
#include "core/segmentation/square_sums.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kMiddle = kStandingFood + 1;  // of a square that stands

}  // namespace

bool add_standing_food(const DishRaster& raster, ImageView<const HeightSample> relief,
                       const HeightWeightParams& weights, const StandingFoodParams& params, double min_mm2,
                       const StandingFoodWorkspace& workspace, ImageView<std::uint8_t> cells) {
  const int radius = square_radius(params.radius_mm, raster.cell_mm);
  const int least = least_of_square(radius, params.least_share);
  const auto stands = [&](int x, int y) {
    return cells.at(x, y) == kGlazeSeed && raster.zones.at(x, y) != DishZone::edge &&
           lift_of(relief.at(x, y), weights) > params.least_lift;
  };
  for_each_square_sum(cells.width, cells.height, radius, workspace.row_sums, workspace.column_sums, stands,
                      [&](int x, int y, int standing) {
                        if (standing >= least && cells.at(x, y) == kGlazeSeed) cells.at(x, y) = kMiddle;
                      });
  const double min_cells = min_mm2 / (raster.cell_mm * raster.cell_mm);
  if (!drop_small(cells, kMiddle, kGlazeSeed, min_cells, workspace.queue)) return false;
  for_each_square_sum(
      cells.width, cells.height, radius, workspace.row_sums, workspace.column_sums,
      [&](int x, int y) { return cells.at(x, y) == kMiddle; },
      [&](int x, int y, int middles) {
        if (middles > 0 && cells.at(x, y) != kBarred) cells.at(x, y) = kStandingFood;
      });
  return true;
}

}  // namespace traygauge
