// Which dish each food item lies on, from the label pictures of a tray with several dishes: the one whose
// pixels it borders most.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/units.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_borders.hpp"

namespace traygauge {

struct DishMembershipParams {
  // Of an item's border with dishes and other items, the share that has to run along one dish for that alone
  // to count, 0 to 1. Below, the item's neighbours decide with it: a dish in front that hides food of another
  // borders that, too, but only shortly. Food beside other food has 79% and more in the rendered trays.
  double min_dish_border_fraction = 0.2;
};

// By item label: the label of its dish; 0 where no dish was found and for labels that are no item's.
using DishOfItem = std::array<std::uint8_t, kByteValues>;

// Borders are summed over `views`. An item that touches only (or almost only) other items takes the dish that
// its neighbours have, each by the length of the border with it. Among equals the dish of the smaller label
// wins. O(pixels); one pass a view.
DishOfItem find_dishes_of_items(std::span<const ImageView<const std::uint8_t>> views,
                                const DishMembershipParams& params, LabelBorders& borders);

}  // namespace traygauge
