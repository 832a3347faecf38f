#include "simulator/capture/dish_description.hpp"

#include <algorithm>

#include "simulator/capture/json_node.hpp"

namespace traygauge {
namespace {

constexpr NumberRange kOuterSizeMm{20.0, 1000.0};
constexpr NumberRange kHeightMm{0.0, 200.0};
constexpr double kProfileToleranceMm = 1.0;  // between a profile's heights and those of rim and bottom
constexpr const char* kProfileHint = "list points from the outer edge inward, down to the flat bottom";

// `dish` has its sizes already.
std::vector<ProfilePoint> read_profile(const JsonNode& node, const DishDescription& dish) {
  const NumberRange insets_mm{0.0, 0.5 * std::min(dish.outer_size_mm[0], dish.outer_size_mm[1])};
  const NumberRange heights_mm{std::max(kHeightMm.min, dish.bottom_height_mm - kProfileToleranceMm),
                               std::min(kHeightMm.max, dish.rim_height_mm + kProfileToleranceMm)};
  std::vector<ProfilePoint> profile;
  for (const JsonNode& element : node.elements(2, kMaxProfilePoints)) {
    const std::vector<JsonNode> pair = element.elements(2, 2);
    const ProfilePoint point{pair[0].number(insets_mm), pair[1].number(heights_mm)};
    if (profile.empty() && point.inset_mm != 0.0) pair[0].fail("0, the outer edge", kProfileHint);
    if (!profile.empty() && point.inset_mm <= profile.back().inset_mm) {
      pair[0].fail("an inset larger than the one before", kProfileHint);
    }
    profile.push_back(point);
  }
  if (profile.back().height_mm > dish.bottom_height_mm + kProfileToleranceMm) {
    node.fail("a last height within 1 mm of bottom_height_mm", kProfileHint);
  }
  return profile;
}

}  // namespace

DishDescription read_dish(const JsonNode& node) {
  DishDescription dish;
  if (const auto style = node.find("style")) dish.style = style->text();
  const std::vector<double> size = node.member("outer_size_mm").numbers(2, kOuterSizeMm);
  dish.outer_size_mm = {size[0], size[1]};
  dish.rim_height_mm = node.member("rim_height_mm").number(kHeightMm);
  dish.bottom_height_mm = node.member("bottom_height_mm").number(kHeightMm);
  if (dish.bottom_height_mm > dish.rim_height_mm) {
    node.member("bottom_height_mm").fail("a height below the rim's", "both count from the table");
  }
  if (const auto profile = node.find("profile")) {
    dish.profile = read_profile(*profile, dish);
  }
  return dish;
}

}  // namespace traygauge
