#include "core/paper/pipeline/configuration.hpp"

#include <algorithm>

#include "core/base/is_within.hpp"
#include "core/paper/pipeline/parameters.hpp"

namespace traygauge::paper {
namespace {

bool is_plausible(const Caps& caps) {
  constexpr int kMaxSide = 8192;
  constexpr int kMaxCount = 1 << 16;
  return is_within(caps.max_keypoints, 16, kMaxCount) && is_within(caps.max_card_keypoints, 0, kMaxCount) &&
         is_within(caps.max_pattern_keypoints, 16, kMaxCount) &&
         is_within(caps.max_feature_px, 1, kMaxSide * kMaxSide) &&
         is_within(caps.max_working_px, 1, kMaxSide * kMaxSide) &&
         is_within(caps.max_working_side_px, 1, kMaxSide);
}

// Takes every parameter with a name, and notes whether all lie in their ranges.
struct RangeCheck {
  bool all_hold = true;

  template <class Number>
  void operator()(const char*, const Number& value, const ParameterRange& range) {
    all_hold = all_hold && range.contains(value);
  }
  template <class Enum>
  void operator()(const char*, const Enum& value, const ParameterChoices& choices) {
    all_hold = all_hold && static_cast<std::size_t>(value) < choices.count();
  }
  void operator()(const char*, bool) {}
};

bool are_parameters_within_range(const Configuration& configuration) {
  RangeCheck check;
  visit_parameters(configuration, check);
  return check.all_hold;
}

bool is_only_dish(const DishModel& dish) {
  return dish.label == kDishLabel;
}

}  // namespace

Status validate(const Configuration& configuration) {
  if (const Status status = traygauge::validate(configuration); !status.ok()) return status;
  for (const Status status : {validate(configuration.surf), validate(configuration.pose),
                              validate(configuration.rectification), validate(configuration.stereo)}) {
    if (!status.ok()) return status;
  }
  const bool holds = is_plausible(configuration.caps) && are_parameters_within_range(configuration) &&
                     std::all_of(configuration.dishes.begin(), configuration.dishes.end(), is_only_dish);
  return holds ? StatusCode::ok : StatusCode::invalid_configuration;
}

}  // namespace traygauge::paper
