// The middle of many numbers, and what it says of their spread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace traygauge {

// Standard deviation over the median size, of normal errors: 1 / Φ⁻¹(3/4).
inline constexpr double kMedianToSigma = 1.4826;
// What lies further off than so many standard deviations is no normal error (one in 370 would).
inline constexpr double kOutlierSigmas = 3.0;

// The upper one of two in the middle. Reorders the values, of which there is one at least.
inline double median(std::span<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace traygauge
