#include "core/segmentation/food_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

double colour_sign(const CellColour& colour, const GlazeColour& glaze, const FoodEvidenceParams& params) {
  const int red = colour.red - glaze.red;
  const int green = colour.green - glaze.green;
  const double deviations = std::sqrt(red * red + green * green) / glaze.share_sigma;
  const double beyond =
      (deviations - params.neutral_deviations) / (params.full_deviations - params.neutral_deviations);
  return std::clamp(beyond, params.least_colour, params.most_colour);
}

}  // namespace

FoodSigns food_signs(const DishInView& dish, const GlazeColour& glaze, const FoodEvidenceParams& params,
                     int x, int y, int side, const CellColour& mean) {
  FoodSigns signs;
  for (int j = y; j < y + side; ++j) {
    for (int i = x; i < x + side; ++i) {
      const double told = lift_of(dish.relief.at(i, j), params.relief);
      (told > 0.0 ? signs.lift : signs.against) += told;
    }
  }
  const int count = side * side;
  signs.lift /= count;
  signs.against /= count;
  signs.colour = colour_sign(mean, glaze, params);
  const double middle = 0.5 * (side - 1);
  const auto margin =
      static_cast<double>(dish.reading.margin_at(dish.raster.pixel_of(x + middle, y + middle)));
  signs.margin = std::clamp(margin, -params.most_margin, params.most_margin);
  return signs;
}

}  // namespace traygauge
