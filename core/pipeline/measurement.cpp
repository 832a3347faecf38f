#include "core/pipeline/measurement.hpp"

#include <algorithm>

namespace traygauge {
namespace {

// In the order of Stage.
constexpr std::array<const char*, kStageCount> kStageNames = {
    "image", "features", "matching", "pose", "scale", "rectification", "stereo", "surface", "volume"};

struct WarningText {
  const char* name;
  const char* sentence;
};

// In the order of Warning.
constexpr std::array<WarningText, kWarningCount> kWarnings = {{
    {"angle_small", "The views lie less than 10 degrees apart; heights are uncertain."},
    {"angle_large", "The views lie more than 30 degrees apart; parts of the food may be matched wrongly."},
    {"keypoints_capped",
     "Most salient points of a picture were left out; a busy table may crowd out the food."},
    {"matches_capped", "More corresponding points than memory was reserved for; some were left out."},
    {"few_card_points", "The scale rests on few points of the card; check its print for glare and dirt."},
    {"dish_guessed", "The dish was not given; it was chosen by its rim from the known dishes."},
    {"arm_angle_disagrees", "The angle between the views differs from the arm's; check arm and mount."},
    {"pose_from_card", "The camera motion was taken from the card because the scene alone was ambiguous."},
    {"blurred", "A picture is blurred; focus the camera and hold it still."},
    {"underexposed", "A picture is dark; add light or expose longer."},
    {"card_partly_hidden", "The reference card is not seen whole and flat; uncover it."},
    {"food_clipped", "Part of an item is burnt out or black; change the exposure or remove the glare."},
    {"little_texture", "Part of an item has too little texture to be matched, or too much noise over it."},
    {"exposure_differs", "One picture is much brighter than the other; keep light and exposure the same."},
    {"white_balance_differs",
     "The colours of the two pictures differ; keep light and white balance the same."},
    {"item_hardly_matched",
     "Large parts of an item could not be found in both views, as on smooth, shining food; its volume may be "
     "far off."},
    {"dish_not_found",
     "A dish was not found whole in both pictures, and its food is not measured; see traygauge segment."},
    {"item_uncertain",
     "An item's volume is less sure than usual, as of steep pieces with gaps; see its sigma, or measure from "
     "another side."},
    {"items_doubtful",
     "It is not sure where one food ends and the next begins; give the number of items, or correct the "
     "outlines that traygauge segment shows."},
}};

}  // namespace

const char* name(Stage stage) {
  return kStageNames[static_cast<std::size_t>(stage)];
}
const char* name(Warning warning) {
  return kWarnings[static_cast<std::size_t>(warning)].name;
}
const char* sentence(Warning warning) {
  return kWarnings[static_cast<std::size_t>(warning)].sentence;
}

Status summarise(std::span<const ItemResult> items) {
  const auto is_measured = [](const ItemResult& item) { return item.status == StatusCode::ok; };
  const auto measured = std::count_if(items.begin(), items.end(), is_measured);
  if (measured == static_cast<std::ptrdiff_t>(items.size())) return StatusCode::ok;
  return measured > 0 ? StatusCode::partial : items.front().status;
}

}  // namespace traygauge
