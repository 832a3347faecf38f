// Haar wavelets over an integral image (Bay et al., section 4.1, figure 9).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/image_view/image_view.hpp"

namespace traygauge::paper {

struct HaarResponse {
  float dx = 0.0F;  // right half minus left half
  float dy = 0.0F;  // lower half minus upper half
};

// The wavelet of 2 · half pixels a side around the corner of pixels (x, y). With kClamp the parts outside of
// the picture are cut off; without, it must lie inside.
template <bool kClamp>
inline HaarResponse haar_response(ImageView<const std::uint32_t> integral, int x, int y, int half) {
  const auto clamp_x = [&](int value) { return kClamp ? std::clamp(value, 0, integral.width - 1) : value; };
  const auto clamp_y = [&](int value) { return kClamp ? std::clamp(value, 0, integral.height - 1) : value; };
  const std::uint32_t* top = integral.row(clamp_y(y - half));
  const std::uint32_t* middle = integral.row(clamp_y(y));
  const std::uint32_t* bottom = integral.row(clamp_y(y + half));
  const int left = clamp_x(x - half);
  const int centre = clamp_x(x);
  const int right = clamp_x(x + half);
  const std::uint32_t outer = bottom[right] + top[left];
  const std::uint32_t inner = bottom[left] + top[right];
  const std::uint32_t dx = outer - inner + 2U * (bottom[left] - bottom[centre] + top[centre] - top[left]);
  const std::uint32_t dy = outer - inner + 2U * (middle[left] - middle[right] + top[right] - top[left]);
  return {static_cast<float>(static_cast<std::int32_t>(dx)),
          static_cast<float>(static_cast<std::int32_t>(dy))};
}

// Sample positions in 1 / 65536 pixels of the corner grid, where pixel centres lie at one half.
inline constexpr int kFixedBits = 16;

inline std::int32_t to_corner_fixed(double pixel) {
  return static_cast<std::int32_t>(std::floor((pixel + 0.5) * (1 << kFixedBits) + 0.5));
}
inline std::int32_t to_fixed_step(float pixels) {
  return static_cast<std::int32_t>(std::floor(pixels * (1 << kFixedBits) + 0.5F));
}
inline int round_fixed(std::int32_t position) {
  return (position + (1 << (kFixedBits - 1))) >> kFixedBits;
}

// Whether wavelets within `reach` of the point stay inside the picture.
inline bool fits_inside(ImageView<const std::uint32_t> integral, double x, double y, double reach) {
  return x - reach >= 1.0 && y - reach >= 1.0 && x + reach <= integral.width - 3.0 &&
         y + reach <= integral.height - 3.0;
}

}  // namespace traygauge::paper
