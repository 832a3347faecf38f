#include "core/pipeline/tray_setup.hpp"

#include "core/base/is_within.hpp"

namespace traygauge {
namespace {

bool is_plausible(const ReferenceCard& card) {
  // What is a slip of units or digits.
  constexpr double kMinSideMm = 10.0;
  constexpr double kMaxSideMm = 500.0;
  constexpr double kMaxThicknessMm = 10.0;
  constexpr int kMinPatternPx = 64;
  return is_within(card.width_mm, kMinSideMm, kMaxSideMm) &&
         is_within(card.height_mm, kMinSideMm, kMaxSideMm) &&
         is_within(card.thickness_mm, 0.0, kMaxThicknessMm) && !card.pattern.empty() &&
         card.pattern.width >= kMinPatternPx && card.pattern.height >= kMinPatternPx;
}

bool is_plausible(const FrameLimits& limits) {
  // What is a slip of digits.
  constexpr int kMinSide = 16;
  constexpr int kMaxSide = 8192;
  return is_within(limits.max_frame_width, kMinSide, kMaxSide) &&
         is_within(limits.max_frame_height, kMinSide, kMaxSide);
}

}  // namespace

Status validate_apart_from_dishes(const TraySetup& setup) {
  if (const Status status = validate(setup.lens); !status.ok()) return status;
  return is_plausible(setup.card) && is_plausible(setup.limits) ? StatusCode::ok
                                                                : StatusCode::invalid_configuration;
}

Status validate_dishes(std::span<const DishModel> dishes) {
  if (dishes.empty() || dishes.size() > kMaxDishCandidates) return StatusCode::invalid_configuration;
  return validate(dishes);
}

Status validate(const TraySetup& setup) {
  const Status status = validate_apart_from_dishes(setup);
  return status.ok() ? validate_dishes(setup.dishes) : status;
}

}  // namespace traygauge
