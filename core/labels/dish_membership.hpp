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
  // Of all of an item's border, background included. What stands on a dish's edge has about half of it there;
  // what stands beside the dish and is seen before or behind it has less until its middle is hidden.
  double max_passing_border_fraction = 0.3;
};

// By item label: the label of its dish; 0 where no dish was found and for labels that are no item's.
using DishOfItem = std::array<std::uint8_t, kByteValues>;

// Borders are summed over `views`. An item that touches only (or almost only) other items takes the dish that
// its neighbours have, each by the length of the border with it. Among equals the dish of the smaller label
// wins. O(pixels); one pass a view.
DishOfItem find_dishes_of_items(std::span<const ImageView<const std::uint8_t>> views,
                                const DishMembershipParams& params, LabelBorders& borders);

// The item's border with dishes is short enough to pass for one before or behind it. After the above.
bool lies_apart(std::uint8_t item, const DishMembershipParams& params, const LabelBorders& borders);

}  // namespace traygauge
