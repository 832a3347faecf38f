#pragma once

namespace traygauge {

// Both ends belong to it; false for NaN.
constexpr bool is_within(double value, double low, double high) {
  return value >= low && value <= high;
}

}  // namespace traygauge
