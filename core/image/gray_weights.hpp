// The weights of grey: ITU-R BT.601 (0.299, 0.587, 0.114) in 15 bits, rounded so that they add up to one.
#pragma once

#include <cstdint>

#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr std::uint32_t kGrayOne = 1U << 15U;  // the weights' unit, 15 bits

// In the order of the bytes of a pixel.
struct GrayWeights {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::uint32_t third = 0;
};

constexpr GrayWeights gray_weights(PixelFormat format) {
  constexpr std::uint32_t green = 19235;
  constexpr std::uint32_t blue = 3735;
  constexpr std::uint32_t red = kGrayOne - green - blue;
  if (format == PixelFormat::bgr8) return {blue, green, red};
  if (format == PixelFormat::rgb8) return {red, green, blue};
  return {kGrayOne, 0, 0};
}

}  // namespace traygauge
