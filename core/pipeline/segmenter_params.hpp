// The parameters of labels that nobody drew.
#pragma once

#include <array>

#include "core/card/card_location.hpp"
#include "core/dish/dish_search.hpp"
#include "core/quality/picture_colour.hpp"
#include "core/segmentation/food_outline.hpp"
#include "core/segmentation/height_evidence.hpp"

namespace traygauge {

// Of food beside the dishes, as the network sees it.
struct TrayPlaceParams {
  double min_area_mm2 = 600.0;    // of the box around it, on the table: a roll's has 5,000, a crumb's 100
  double most_height_mm = 60.0;   // of what is laid on a tray
  double max_barred_share = 0.3;  // of its border, along dishes and card; more hangs over a dish's edge
  double min_shared = 0.5;        // of the smaller of two views' places for one piece
  double around_mm = 20.0;        // of the ground that is looked at with it
};

struct SegmenterParams {
  PictureColourParams colour;
  CardSearchParams card;
  DishSearchParams dish;
  HeightEvidenceParams relief;
  FoodOutlineParams food;
  TrayPlaceParams tray;
  // Items on the tray, as a menu says; 0: not known.
  int items = 0;
  // Where more items are known than were found, borders count that differ less than food.split asks for, in
  // steps, down to this share of it: weaker ones lie within an item.
  double weakest_border = 0.5;
  double border_step = 0.85;
  // With each of these steps, and where fewer items are known, parts must be more or less alike by so much,
  // as food.split.likeness has it; more than that is no likeness.
  double likeness_step = 0.5;
  double most_likeness = 6.0;
  // Two items that are more alike may be one: about even odds, without what food.split.likeness.constant
  // takes off them.
  double doubtful_likeness = -1.8;
  // Inset from the outer edge where a flange begins, which is as wide as that at least; and the depth below
  // the edge where the well begins.
  double flange_begin_mm = 2.5;
  double flange_depth_mm = 6.0;
  // Over the bottom of the dish, between which food is seen; what is carried to the other view counts where
  // both lead to the same item.
  std::array<double, 2> food_heights_mm{3.0, 22.0};
  // Of the card's alignment.
  int max_alignments = CardRoundsParams{}.max_alignments;
  double sure_correlation = CardRoundsParams{}.sure_correlation;
};

}  // namespace traygauge
