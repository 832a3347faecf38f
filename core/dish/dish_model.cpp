#include "core/dish/dish_model.hpp"

#include <algorithm>
#include <array>

#include "core/base/is_within.hpp"

namespace traygauge {
namespace {

// Dishes of any kind, and what is a slip of units or digits.
constexpr double kMinSizeMm = 20.0;
constexpr double kMaxSizeMm = 1000.0;
constexpr double kMaxHeightMm = 200.0;

bool is_plausible_profile(const DishModel& dish) {
  if (!dish.has_profile()) return true;
  if (dish.profile_size == 1 || dish.profile_size > kMaxDishProfilePoints) return false;
  const double max_inset_mm = 0.5 * std::min(dish.outer_size_mm[0], dish.outer_size_mm[1]);
  double previous_mm = -1.0;
  for (const DishProfilePoint& point : dish.profile()) {
    if (!is_within(point.inset_mm, 0.0, max_inset_mm) || point.inset_mm <= previous_mm) return false;
    if (!is_within(point.height_mm, 0.0, kMaxHeightMm)) return false;
    previous_mm = point.inset_mm;
  }
  return true;
}

}  // namespace

Status validate(const DishModel& dish) {
  const bool is_plausible = is_dish(dish.label) && is_within(dish.outer_size_mm[0], kMinSizeMm, kMaxSizeMm) &&
                            is_within(dish.outer_size_mm[1], kMinSizeMm, kMaxSizeMm) &&
                            is_within(dish.bottom_height_mm, 0.0, kMaxHeightMm) &&
                            is_within(dish.rim_height_mm, dish.bottom_height_mm, kMaxHeightMm) &&
                            is_plausible_profile(dish);
  return is_plausible ? StatusCode::ok : StatusCode::invalid_configuration;
}

Status validate(std::span<const DishModel> dishes) {
  std::array<bool, 256> seen{};
  bool is_repeated = false;
  bool has_further = false;
  for (const DishModel& dish : dishes) {
    if (const Status status = validate(dish); !status.ok()) return status;
    is_repeated = is_repeated || seen[dish.label];
    has_further = has_further || dish.label != kDishLabel;
    seen[dish.label] = true;
  }
  return is_repeated && has_further ? StatusCode::invalid_configuration : StatusCode::ok;
}

}  // namespace traygauge
