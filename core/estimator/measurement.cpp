#include "core/estimator/measurement.hpp"

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

}  // namespace traygauge
