#include "core/base/status.hpp"

#include <array>
#include <cstddef>

namespace traygauge {
namespace {

struct Text {
  const char* name;
  const char* sentence;
};

// In the order of StatusCode.
constexpr auto kTexts = std::to_array<Text>({
    {"ok", "Measured."},
    {"partial", "Some items could not be measured; see the status of each."},
    {"invalid_configuration",
     "The configuration holds a value outside its range; run `traygauge measure` on a capture whose camera, "
     "card and dish are plausible."},
    {"out_of_memory",
     "The memory reserved at start is too small for this configuration; see `traygauge memory`."},
    {"frame_missing", "A view is missing; two pictures of the dish are needed."},
    {"frame_size_mismatch", "The picture does not have the size that the camera's calibration was made for."},
    {"labels_size_mismatch", "The label image does not have the size of its picture."},
    {"frame_too_dark", "The picture is almost black; check the light, the lens cap and the exposure."},
    {"frame_too_bright", "The picture is burnt out; lower the exposure or remove the glare."},
    {"no_dish_label", "No pixel is labelled as dish; outline the dish in both views."},
    {"no_food_label", "No food item is labelled in both views; outline at least one item."},
    {"too_many_dishes", "More than eight dishes are labelled; measure the tray in parts."},
    {"dish_cut_off", "The dish is cut off by the edge of the picture; move it into the middle."},
    {"too_blurred", "The picture is blurred; focus the camera and hold it still."},
    {"card_hidden",
     "Part of the reference card is covered, cut off or bent; lay it flat beside the dish, fully visible in "
     "both "
     "pictures."},
    {"exposure_differs",
     "One picture is far brighter than the other; take both in the same light with the same exposure."},
    {"white_balance_differs",
     "The colours of the two pictures differ; take both in the same light with the same white balance."},
    {"too_few_features",
     "The picture has too little texture to find corresponding points; check focus and light."},
    {"too_few_matches",
     "Too few points correspond between the two pictures; they may show different scenes or lie too far "
     "apart."},
    {"views_identical", "Both pictures are the same; move the camera between them."},
    {"views_too_close",
     "The camera moved too little between the pictures; aim for an angle of 15 to 20 degrees."},
    {"views_too_far_apart",
     "The camera moved too far between the pictures; aim for an angle of 15 to 20 degrees."},
    {"pose_not_found",
     "No camera motion explains the corresponding points; keep the scene still between the pictures."},
    {"pose_contradicts_card",
     "The camera motion found from the scene contradicts the reference card; card and dish must not move "
     "between the pictures."},
    {"card_not_found",
     "The reference card was not found in both pictures; lay it flat beside the dish, fully visible and "
     "without glare."},
    {"scale_not_found",
     "The reference card gave no consistent scale; check that it is flat and that its size in the "
     "configuration is right."},
    {"labels_inconsistent",
     "The outlines of the two views contradict each other; check that each label image belongs to its "
     "picture."},
    {"rectification_failed",
     "The two views could not be aligned for dense matching: seen from the dish, one camera stands behind "
     "the other; move it sideways between the pictures, not nearer or farther."},
    {"disparity_range_too_large",
     "The depth range of the scene exceeds the configured number of disparities; take the views closer "
     "together."},
    {"rim_not_found", "The rim of the dish was not found; it must be visible in both pictures."},
    {"table_not_found",
     "The plane of the table was not found from the card; lay the card flat on the table."},
    {"dish_unknown",
     "The dish has neither the size nor the height of a known one; describe it in the capture or in "
     "config/dishes."},
    {"too_little_depth", "Too few pixels could be matched densely; check focus, light and reflections."},
    {"item_too_small", "The item covers too few pixels to be measured."},
    {"item_hidden", "The item is not visible in both pictures."},
    {"item_below_dish",
     "The item came out below the bottom of the dish; check the dish's height in the configuration."},
    {"item_clipped",
     "Most of the item is burnt out or black in a picture; change the exposure or remove the glare."},
    {"item_textureless", "The item shows too little texture to be matched; check focus, light and noise."},
});

static_assert(kTexts.size() == static_cast<std::size_t>(StatusCode::item_textureless) + 1);

}  // namespace

const char* name(StatusCode code) {
  return kTexts[static_cast<std::size_t>(code)].name;
}

const char* sentence(StatusCode code) {
  return kTexts[static_cast<std::size_t>(code)].sentence;
}

}  // namespace traygauge
