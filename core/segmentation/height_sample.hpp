// What the comparison of both views says about one place on a dish.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/stereo/symmetric_census.hpp"

namespace traygauge {

inline constexpr double kHeightUnitMm = 0.5;  // 127 of them, the most a byte holds, are 63 mm

struct HeightSample {
  std::int8_t height = 0;       // over the dish's surface, in kHeightUnitMm
  std::uint8_t food_cost = 0;   // twice the census bits in which the views differ, matched there
  std::uint8_t glaze_cost = 0;  // … and on the dish's own surface
  bool is_known : 1 = false;
  bool is_confirmed : 1 = false;  // the other view found the same surface

  double height_mm() const { return kHeightUnitMm * height; }
};

// Half or twice of any number here moves the MAPE of six pairs of the captures with found outlines by 0.11
// points at most (tests/evaluation/numbers.tsv), but for twice of min_height_mm (2.7, with the glossy egg of
// m06) and half of full_bits (0.70).
struct HeightWeightParams {
  double min_height_mm = 3.0;  // lower may be glaze
  double full_bits = 9.0;      // of a difference in cost that leaves no doubt
};

// Evidence for food, −1 to 1. Where the match lies above the dish: by how much better it is than the match on
// the dish's surface, if the other view found it, too: beside food that hides the dish from the other view
// any match is better than the dish's. Where it lies on the surface: against food, by how much better it is
// than chance. Where nothing can be matched both are near 0.
inline double lift_of(const HeightSample& sample, const HeightWeightParams& params) {
  if (!sample.is_known) return 0.0;
  const double chance = 0.5 * kSymmetricCensusBits;
  const double bits = sample.height_mm() > params.min_height_mm
                          ? 0.5 * (sample.glaze_cost - sample.food_cost)
                          : -std::max(0.0, chance - 0.5 * sample.food_cost);
  if (bits > 0.0 && !sample.is_confirmed) return 0.0;
  return std::clamp(bits / params.full_bits, -1.0, 1.0);
}

}  // namespace traygauge
