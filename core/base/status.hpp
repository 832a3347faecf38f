// Every way in which a measurement can end, with the sentence that a person reads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace traygauge {

// Each code with its sentence: what happened and what to do. A further code needs its line here, and its
// words for the page (README.md, "How to add").
// clang-format off
#define TRAYGAUGE_STATUS_CODES(CODE) \
  CODE(ok, "Measured.") \
  CODE(partial, "Some items could not be measured; see the status of each.") \
  CODE(invalid_configuration, \
       "The configuration holds a value outside its range; run `traygauge measure` on a capture whose " \
       "camera, card and dish are plausible.") \
  CODE(wrong_call, \
       "The program called the measurement in an order or with arguments that it does not take; please " \
       "report this.") \
  CODE(out_of_memory, \
       "The memory reserved at start is too small for this configuration; see `traygauge memory`.") \
  CODE(frame_missing, "A view is missing; two pictures of the dish are needed.") \
  CODE(frame_size_mismatch, \
       "The picture does not have the size that the camera's calibration was made for.") \
  CODE(labels_size_mismatch, "The label image does not have the size of its picture.") \
  CODE(frame_too_dark, \
       "The picture is almost black; check the light, the lens cap and the exposure.") \
  CODE(frame_too_bright, "The picture is burnt out; lower the exposure or remove the glare.") \
  CODE(picture_without_colour, \
       "The picture is grey, and without colour food is not told from its dish; set the camera's colour, or " \
       "outline card, dish and food in both views.") \
  CODE(no_dish_label, "No pixel is labelled as dish; outline the dish in both views.") \
  CODE(no_card_label, \
       "No pixel is labelled as reference card (255); outline the card in both views, or leave the labels " \
       "out.") \
  CODE(no_food_label, "No food item is labelled in both views; outline at least one item.") \
  CODE(too_many_dishes, "More than eight dishes are labelled; measure the tray in parts.") \
  CODE(too_many_places, \
       "Food lies at more than five places beside the dishes; measure the tray in parts.") \
  CODE(dish_cut_off, "The dish is cut off by the edge of the picture; move it into the middle.") \
  CODE(too_blurred, "The picture is blurred; focus the camera and hold it still.") \
  CODE(card_hidden, \
       "Part of the reference card is covered, cut off or bent; lay it flat beside the dish, fully " \
       "visible in both pictures.") \
  CODE(exposure_differs, \
       "One picture is far brighter than the other; take both in the same light with the same exposure.") \
  CODE(white_balance_differs, \
       "The colours of the two pictures differ; take both in the same light with the same white balance.") \
  CODE(too_few_features, \
       "The picture has too little texture to find corresponding points; check focus and light.") \
  CODE(too_few_matches, \
       "Too few points correspond between the two pictures; they may show different scenes or lie too " \
       "far apart.") \
  CODE(views_identical, "Both pictures are the same; move the camera between them.") \
  CODE(views_too_close, \
       "The camera moved too little between the pictures; aim for an angle of 15 to 20 degrees.") \
  CODE(views_too_far_apart, \
       "The camera moved too far between the pictures; aim for an angle of 15 to 20 degrees.") \
  CODE(pose_not_found, \
       "No camera motion explains the corresponding points; keep the scene still between the pictures.") \
  CODE(pose_contradicts_card, \
       "The camera motion found from the scene contradicts the reference card; card and dish must not " \
       "move between the pictures.") \
  CODE(dish_moved, \
       "Dish and reference card moved against each other between the pictures; keep hands off the tray until " \
       "both are taken.") \
  CODE(scale_disagrees, \
       "Reference card and dish disagree about the scale; check the card's printed size with a ruler, and " \
       "that the dish is the one described.") \
  CODE(card_lifted, \
       "Reference card and dish disagree about where the table is; lay the card flat on what the dish " \
       "stands on, and check its thickness and the dish's height as described.") \
  CODE(card_not_flat, \
       "Reference card and dish do not lie in parallel planes; lay the card flat on what the dish stands on, " \
       "with nothing under card or dish, and use a card that is not bent.") \
  CODE(dish_differs, \
       "The dish's surface does not lie where its description puts it; check which dish it is and its " \
       "description, or describe it anew with traygauge enrol-dish.") \
  CODE(lens_does_not_fit, \
       "Card and dishes agree through another lens than the one described; calibrate the camera anew, or " \
       "check that its values were made for this lens and this mode of the camera.") \
  CODE(card_not_found, \
       "The reference card was not found in both pictures; lay it flat beside the dish, fully visible " \
       "and without glare.") \
  CODE(scale_not_found, \
       "The reference card gave no consistent scale; check that it is flat and that its size in the " \
       "configuration is right.") \
  CODE(labels_inconsistent, \
       "The outlines of the two views contradict each other; check that each label image belongs to its " \
       "picture.") \
  CODE(rectification_failed, \
       "The two views could not be aligned for dense matching: seen from the dish, one camera stands " \
       "behind the other; move it sideways between the pictures, not nearer or farther.") \
  CODE(disparity_range_too_large, \
       "The depth range of the scene exceeds the configured number of disparities; take the views " \
       "closer together.") \
  CODE(rim_not_found, "The rim of the dish was not found; it must be visible in both pictures.") \
  CODE(table_not_found, \
       "The plane of the table was not found from the card; lay the card flat on the table.") \
  CODE(dish_unknown, \
       "The dish has neither the size nor the height of a known one; describe it in the capture or in " \
       "config/dishes.") \
  CODE(too_little_depth, \
       "Too few pixels could be matched densely; check focus, light and reflections.") \
  CODE(item_too_small, "The item covers too few pixels to be measured.") \
  CODE(item_hidden, "The item is not visible in both pictures.") \
  CODE(item_cut_off, "The item is cut off by the edge of the picture; move it into the middle.") \
  CODE(item_moved, \
       "The item moved on its dish between the pictures; keep the tray still until both are taken.") \
  CODE(item_below_dish, \
       "The item came out below the bottom of the dish; check the dish's height in the configuration.") \
  CODE(item_clipped, \
       "Most of the item is burnt out or black in a picture; change the exposure or remove the glare.") \
  CODE(item_textureless, \
       "The item shows too little texture to be matched; check focus, light and noise.")
// clang-format on

enum class StatusCode : std::uint8_t {
#define TRAYGAUGE_CODE(name, text) name,
  TRAYGAUGE_STATUS_CODES(TRAYGAUGE_CODE)
#undef TRAYGAUGE_CODE
};

#define TRAYGAUGE_NAME(name, text) #name,
inline constexpr auto kStatusNames = std::to_array<const char*>({TRAYGAUGE_STATUS_CODES(TRAYGAUGE_NAME)});
#undef TRAYGAUGE_NAME
inline constexpr std::size_t kStatusCodeCount = kStatusNames.size();

// The code as the JSON contract spells it, e.g. "card_not_found".
const char* name(StatusCode code);

// One sentence: what happened and what to do.
const char* sentence(StatusCode code);

// The outcome of a function that can fail.
class [[nodiscard]] Status {
 public:
  constexpr Status() = default;
  constexpr Status(StatusCode code) : code_(code) {}  // NOLINT(google-explicit-constructor): reads as a value
  constexpr bool ok() const { return code_ == StatusCode::ok; }
  constexpr StatusCode code() const { return code_; }

 private:
  StatusCode code_ = StatusCode::ok;
};

}  // namespace traygauge
