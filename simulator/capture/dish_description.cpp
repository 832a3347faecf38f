#include "simulator/capture/dish_description.hpp"

#include <algorithm>
#include <cstddef>

namespace traygauge {
namespace {

constexpr NumberRange kOuterSizeMm{20.0, 1000.0};
constexpr NumberRange kHeightMm{0.0, 200.0};
constexpr std::size_t kMaxProfilePoints = 1000;

std::vector<ProfilePoint> read_profile(const JsonNode& node, double max_inset_mm) {
  std::vector<ProfilePoint> profile;
  for (const JsonNode& element : node.elements(2, kMaxProfilePoints)) {
    const std::vector<JsonNode> pair = element.elements(2, 2);
    const ProfilePoint point{pair[0].number({0.0, max_inset_mm}), pair[1].number(kHeightMm)};
    if (!profile.empty() && point.inset_mm <= profile.back().inset_mm) {
      pair[0].fail("an inset larger than the one before", "list the points from the outer edge inward");
    }
    profile.push_back(point);
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
    dish.profile = read_profile(*profile, 0.5 * std::min(size[0], size[1]));
  }
  return dish;
}

}  // namespace traygauge
