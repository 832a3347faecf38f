#include "core/pipeline/configuration.hpp"

#include <algorithm>

#include "core/base/is_within.hpp"
#include "core/pipeline/parameters.hpp"

namespace traygauge {
namespace {

bool is_plausible(const ReferenceCard& card) {
  constexpr double kMinSideMm = 10.0;
  constexpr double kMaxSideMm = 500.0;
  constexpr double kMaxThicknessMm = 10.0;
  constexpr int kMinPatternPx = 64;
  return is_within(card.width_mm, kMinSideMm, kMaxSideMm) &&
         is_within(card.height_mm, kMinSideMm, kMaxSideMm) &&
         is_within(card.thickness_mm, 0.0, kMaxThicknessMm) && !card.pattern.empty() &&
         card.pattern.width >= kMinPatternPx && card.pattern.height >= kMinPatternPx;
}

bool is_plausible(const EstimatorLimits& limits) {
  constexpr int kMaxSide = 8192;
  constexpr int kMaxCount = 1 << 16;
  return is_within(limits.max_frame_width, 16, kMaxSide) &&
         is_within(limits.max_frame_height, 16, kMaxSide) && is_within(limits.max_keypoints, 16, kMaxCount) &&
         is_within(limits.max_card_keypoints, 0, kMaxCount) &&
         is_within(limits.max_pattern_keypoints, 16, kMaxCount) &&
         is_within(limits.max_feature_px, 1, kMaxSide * kMaxSide) &&
         is_within(limits.max_working_px, 1, kMaxSide * kMaxSide) &&
         is_within(limits.max_working_side_px, 1, kMaxSide);
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
  visit_shared_parameters(configuration, check);
  visit_parameters_of(configuration.profile, configuration, check);
  visit_segmentation_parameters(configuration.segmentation, check);
  return check.all_hold;
}

// Profile paper measures trays with one dish.
bool is_only_dish(const DishModel& dish) {
  return dish.label == kDishLabel;
}

}  // namespace

Status validate_apart_from_dishes(const Configuration& configuration) {
  if (const Status status = validate(configuration.lens); !status.ok()) return status;
  if (!is_plausible(configuration.card) || !is_plausible(configuration.limits))
    return StatusCode::invalid_configuration;
  for (const Status status : {validate(configuration.surf), validate(configuration.pose),
                              validate(configuration.rectification), validate(configuration.stereo)}) {
    if (!status.ok()) return status;
  }
  return are_parameters_within_range(configuration) ? StatusCode::ok : StatusCode::invalid_configuration;
}

Status validate(const Configuration& configuration) {
  if (configuration.dishes.empty() || configuration.dishes.size() > kMaxDishCandidates) {
    return StatusCode::invalid_configuration;
  }
  if (const Status status = validate_apart_from_dishes(configuration); !status.ok()) return status;
  if (const Status status = validate(configuration.dishes); !status.ok()) return status;
  if (configuration.profile == Profile::best) return StatusCode::ok;
  return std::all_of(configuration.dishes.begin(), configuration.dishes.end(), is_only_dish)
             ? StatusCode::ok
             : StatusCode::invalid_configuration;
}

}  // namespace traygauge
