// Sums of a convolution made values of 8 bits, in integers alone.
#pragma once

#include <algorithm>
#include <cstdint>

namespace traygauge {

// A half, 2^(shift - 1), is then 1 to 2^61; a product is at most 2^62.
inline constexpr int kMinRescalingShift = 1;
inline constexpr int kMaxRescalingShift = 62;

// sum · multiplier / 2^shift, rounded to the nearest, halves upward: MultiplyByQuantizedMultiplier of
// TensorFlow Lite with single rounding (tensorflow/lite/kernels/internal/common.cc under
// TFLITE_SINGLE_ROUNDING; its shift is 31 less ours). For any sum, multipliers that are not negative and
// shifts of the range above nothing overflows.
constexpr std::int64_t rescale(std::int32_t sum, std::int32_t multiplier, int shift) {
  const std::int64_t half = std::int64_t{1} << (shift - 1);
  return (std::int64_t{sum} * multiplier + half) >> shift;
}

// What does not fit is saturated: a ReLU's output holds 0 to 255, another -128 to 127 (two's complement).
constexpr std::uint8_t saturate(std::int64_t value, bool has_relu) {
  const std::int64_t low = has_relu ? 0 : -128;
  return static_cast<std::uint8_t>(std::clamp(value, low, low + 255));
}

// A byte as two's complement has it.
constexpr std::int16_t signed_value(std::uint8_t byte) {
  return static_cast<std::int8_t>(byte);
}

}  // namespace traygauge
