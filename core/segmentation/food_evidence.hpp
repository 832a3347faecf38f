// Signs that a place on a dish is food, and what they say together.
#pragma once

#include <cstddef>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/glaze.hpp"
#include "core/segmentation/height_sample.hpp"
#include "core/segmentation/picture_reading.hpp"

namespace traygauge {

// What each sign adds to the logarithm of the odds that a place is food, and what there is without any.
struct FoodWeights {
  double constant;
  double lift;
  double against;
  double colour;
  double margin;
};

struct FoodEvidenceParams {
  HeightWeightParams relief;
  // Deviations of the colour from the glaze's that speak neither way, and those that count once. Others count
  // in proportion: not below `least_colour`, since white food has the glaze's own colour, too, nor beyond
  // `most_colour`.
  double neutral_deviations = 7.0;
  double full_deviations = 10.0;
  double least_colour = -0.25;
  double most_colour = 3.0;
  // Up to which the network's margin counts, either way: a food unlike those that it learned it may take for
  // something else without a doubt.
  double most_margin = 4.0;
  // A logistic regression of places on rendered dishes, of which the network misses 3 % of the food:
  // tests/evaluation/fit/fit_food_evidence.py.
  double constant = -1.62;
  double lift_weight = 2.94;
  double against_weight = 1.17;
  double colour_weight = 1.69;
  double margin_weight = 0.81;
  // Near food that stands although the network denies it. The same script's regression of places that have
  // the glaze's colour, half of which count as food.
  double denied_constant = 0.07;
  double denied_lift_weight = 5.10;
  double denied_against_weight = 2.02;

  FoodWeights usual() const { return {constant, lift_weight, against_weight, colour_weight, margin_weight}; }
  FoodWeights where_denied() const {
    return {denied_constant, denied_lift_weight, denied_against_weight, colour_weight, 0.0};
  }
};

struct FoodSigns {
  double lift = 0.0;     // 0 to 1: how surely something stands over the dish
  double against = 0.0;  // -1 to 0: how surely the dish's own surface is seen
  double colour = 0.0;   // how far it is from the glaze's
  double margin = 0.0;   // the network's

  double log_odds(const FoodWeights& weights) const {
    return weights.constant + weights.lift * lift + weights.against * against + weights.colour * colour +
           weights.margin * margin;
  }
};

// Is told what each place of a dish shows while food is found: for people, and for what is fitted to it.
class FoodObserver {
 public:
  // What follows is of this view, until the next call; a dish may come more than once.
  virtual void on_view(std::size_t view) = 0;
  // A square of the frame, by its middle and its side.
  virtual void on_place(const Vec2& pixel, int side_px, const FoodSigns& signs, double log_odds) = 0;

 protected:
  ~FoodObserver() = default;
};

// What one view shows of a dish.
struct DishInView {
  const DishRaster& raster;
  ImageView<const HeightSample> relief;  // of the raster's size; where nothing is known it says nothing
  const PictureReading& reading;
  FoodObserver* observer = nullptr;
  bool holds_only_food = true;  // whatever stands on it is food, unlike on a tray
};

// Of the square of side x side cells of the raster whose first is (x, y), and whose mean colour is `mean`.
FoodSigns food_signs(const DishInView& dish, const GlazeColour& glaze, const FoodEvidenceParams& params,
                     int x, int y, int side, const CellColour& mean);

}  // namespace traygauge
