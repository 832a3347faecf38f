// How well label pictures agree with those that are known to be right.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulator/capture/picture.hpp"

namespace traygauge {

struct ItemScore {
  int label = 0;  // in the true labels
  int found = 0;  // the label found that covers it best; 0: none
  double iou = 0.0;
};

struct DishScore {
  int label = 0;
  double axes_error = 0.0;  // of the ellipse around the dish, the larger of both, as a share; 1: not found
};

// Of one view.
struct LabelScores {
  double food_iou = 0.0;  // intersection over union of all that is food
  double card_iou = 0.0;
  std::vector<ItemScore> items;
  std::vector<DishScore> dishes;
  int items_found = 0;

  double mean_item_iou() const;
  bool has_right_count() const { return items_found == static_cast<int>(items.size()); }
};

// Both of one size.
LabelScores score_labels(const Picture& found, const Picture& truth);

// By label found: the true label that it stands for in both views, each used once, best overlap first; 0
// where it stands for none. Overlaps below a quarter do not count.
std::array<std::uint8_t, 256> match_items(const std::array<Picture, 2>& found,
                                          const std::array<Picture, 2>& truth);

}  // namespace traygauge
