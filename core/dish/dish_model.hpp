// A dish as it is described: rim, bottom and inner surface. Lengths in mm, heights above the table.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/status.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

inline constexpr std::size_t kMaxPlacedDishes = 8;     // on one tray, that are measured
inline constexpr std::size_t kMaxDishCandidates = 64;  // that are known

// A point of the inner surface: so far from the outer edge, measured as an inset d of the rim's ellipse,
// (x/(a-d))² + (y/(b-d))² = 1.
struct DishProfilePoint {
  double inset_mm = 0.0;
  double height_mm = 0.0;
};

// That a profile may be described by; bounds its memory.
inline constexpr std::size_t kMaxDishProfilePoints = 32;

struct DishModel {
  std::array<double, 2> outer_size_mm{};  // of the rim's ellipse; equal when round
  double rim_height_mm = 0.0;
  double bottom_height_mm = 0.0;
  // From the edge inward down to the flat bottom, monotone cubic between; none: a flat bottom.
  std::array<DishProfilePoint, kMaxDishProfilePoints> profile_points{};
  std::size_t profile_size = 0;
  std::uint8_t label = kDishLabel;  // in the label pictures

  constexpr std::span<const DishProfilePoint> profile() const {
    return std::span(profile_points).first(profile_size);
  }
  constexpr bool has_profile() const { return profile_size > 0; }
};

// Axes that differ by less than it can be made.
inline bool is_round_dish(const std::array<double, 2>& size_mm) {
  constexpr double kRoundMm = 0.5;
  return std::abs(size_mm[0] - size_mm[1]) < kRoundMm;
}

// invalid_configuration when a size, a height, the label or the profile lies outside its range: insets grow,
// up to half the smaller axis.
Status validate(const DishModel& dish);

// Labels 1 and 201 … 249, each for one dish; or label 1 for all: candidates for the only dish.
// invalid_configuration otherwise, and when a dish itself is.
Status validate(std::span<const DishModel> dishes);

}  // namespace traygauge
