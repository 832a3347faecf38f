// Doubts that do not stop a measurement, and about what they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/labels/label_set.hpp"

namespace traygauge {

// Each warning with the sentence that a person reads.
// clang-format off
#define TRAYGAUGE_WARNINGS(CODE) \
  CODE(angle_small, "The views lie less than 10 degrees apart; heights are uncertain.") \
  CODE(angle_large, \
       "The views lie more than 30 degrees apart; parts of the food may be matched wrongly.") \
  CODE(keypoints_capped, \
       "Most salient points of a picture were left out; a busy table may crowd out the food.") \
  CODE(matches_capped, "More corresponding points than memory was reserved for; some were left out.") \
  CODE(few_card_points, \
       "The scale rests on few points of the card; check its print for glare and dirt.") \
  CODE(dish_guessed, "The dish was not given; it was chosen by its rim from the known dishes.") \
  CODE(arm_angle_disagrees, \
       "The angle between the views differs from the arm's; check arm and mount.") \
  CODE(pose_from_card, \
       "The camera motion was taken from the card because the scene alone was ambiguous.") \
  CODE(blurred, "A picture is blurred; focus the camera and hold it still.") \
  CODE(underexposed, "A picture is dark; add light or expose longer.") \
  CODE(card_partly_hidden, "The reference card is not seen whole and flat; uncover it.") \
  CODE(food_clipped, \
       "Part of an item is burnt out or black; change the exposure or remove the glare.") \
  CODE(little_texture, \
       "Part of an item has too little texture to be matched, or too much noise over it.") \
  CODE(exposure_unequal, \
       "One picture is much brighter than the other; keep light and exposure the same.") \
  CODE(white_balance_unequal, \
       "The colours of the two pictures differ; keep light and white balance the same.") \
  CODE(item_hardly_matched, \
       "Large parts of an item could not be found in both views, as on smooth, shining food; its volume " \
       "may be far off.") \
  CODE(dish_not_found, \
       "A dish was not found whole in both pictures, and its food is not measured; see traygauge " \
       "segment.") \
  CODE(dish_moved, "Dish and reference card moved against each other between the pictures.") \
  CODE(scale_disagrees, \
       "Reference card and dish disagree about the scale; check the card's printed size, and the dish's " \
       "description.") \
  CODE(card_lifted, \
       "Reference card and dish disagree about where the table is; check that the card lies flat, its " \
       "thickness and the dish's description.") \
  CODE(card_not_flat, \
       "Reference card and dish do not quite lie in parallel planes; check that the card is not bent, and that " \
       "nothing lies under card or dish.") \
  CODE(dish_differs, \
       "A dish's surface lies a little off where its description puts it; check which dish it is, and its " \
       "description.") \
  CODE(lens_does_not_fit, \
       "Card and dishes agree better through another lens than the one described; calibrate the camera anew, " \
       "or check that its values were made for this lens and this mode of the camera.") \
  CODE(dish_shape_unknown, \
       "A dish is described without the profile of its inner wall, so what lies on the wall may be far " \
       "off; traygauge enrol-dish measures the profile.") \
  CODE(unknown_object, \
       "Something that no description names stands beside the dishes; what may be in it is not measured.") \
  CODE(item_beside_dishes, \
       "An item lies on none of the dishes. It was measured over the tray; a plate or bowl under it " \
       "counts as food.") \
  CODE(item_moved, \
       "An item seems to have moved a little on its dish between the pictures; its volume may be off.") \
  CODE(lens_dirty, \
       "Part of an item shows nothing at the same place of both pictures, as behind dirt on the lens; clean " \
       "the lens.") \
  CODE(pictures_differ, \
       "Part of an item looks different in the two pictures, as behind a hand, dirt on the lens or steam; " \
       "its volume may be far off.") \
  CODE(dish_empty, "No food was seen on a dish; it counts as empty.") \
  CODE(item_uncertain, \
       "An item's volume is less sure than usual, as of steep pieces with gaps; see its sigma, or " \
       "measure from another side.") \
  CODE(items_doubtful, \
       "It is not sure where one food ends and the next begins; give the number of items, or correct " \
       "the outlines that traygauge segment shows.")
// clang-format on

enum class Warning : std::uint8_t {
#define TRAYGAUGE_CODE(name, text) name,
  TRAYGAUGE_WARNINGS(TRAYGAUGE_CODE)
#undef TRAYGAUGE_CODE
};

#define TRAYGAUGE_NAME(name, text) #name,
inline constexpr auto kWarningNames = std::to_array<const char*>({TRAYGAUGE_WARNINGS(TRAYGAUGE_NAME)});
#undef TRAYGAUGE_NAME
inline constexpr std::size_t kWarningCount = kWarningNames.size();

// As the JSON contract spells it.
const char* name(Warning warning);
const char* sentence(Warning warning);

// Which warnings were raised, each for some items or dishes or for the pair of pictures as a whole.
class WarningSet {
 public:
  // `label` of the item or dish that it is about; kBackgroundLabel: of the pair.
  void raise(Warning warning, std::uint8_t label = kBackgroundLabel) {
    labels_[static_cast<std::size_t>(warning)].add(label);
  }
  void raise_if(bool is_doubtful, Warning warning, std::uint8_t label = kBackgroundLabel) {
    if (is_doubtful) raise(warning, label);
  }
  bool holds(Warning warning) const { return !labels_[static_cast<std::size_t>(warning)].empty(); }
  bool holds(Warning warning, std::uint8_t label) const {
    return labels_[static_cast<std::size_t>(warning)].contains(label);
  }
  bool empty() const {
    return std::all_of(labels_.begin(), labels_.end(), [](const LabelSet& labels) { return labels.empty(); });
  }
  // Calls action(warning, label) for each, in the order of the warnings, then of the labels.
  template <class Action>
  void for_each(Action&& action) const {
    for (std::size_t i = 0; i < kWarningCount; ++i) {
      for (int value = 0; value < 256; ++value) {
        const auto label = static_cast<std::uint8_t>(value);
        if (labels_[i].contains(label)) action(static_cast<Warning>(i), label);
      }
    }
  }

 private:
  std::array<LabelSet, kWarningCount> labels_{};
};

}  // namespace traygauge
