// The values that a parameter of a stage may have: outside of them a measurement would crash, hang, or ask
// for more memory than a board has. What is sensible is far narrower.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace traygauge {

// Both ends belong to it. With a step only its multiples do.
struct ParameterRange {
  double low = 0.0;
  double high = 0.0;
  double step = 0.0;

  // The ends as rounded to the number's type; false for NaN.
  template <class Number>
  bool contains(Number value) const {
    return value >= static_cast<Number>(low) && value <= static_cast<Number>(high) &&
           (step == 0.0 || std::fmod(static_cast<double>(value), step) == 0.0);
  }
};

// Names of an enumeration's values, in their order; null behind the last.
struct ParameterChoices {
  std::array<const char*, 4> names{};

  std::size_t count() const {
    std::size_t count = 0;
    while (count < names.size() && names[count] != nullptr) ++count;
    return count;
  }
};

}  // namespace traygauge
