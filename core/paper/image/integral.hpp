// Sums over upright rectangles in constant time (SURF, section 3.1 of Bay et al. [14]).
#pragma once

#include <cstdint>

#include "core/image_view/image_view.hpp"

namespace traygauge::paper {

// integral(x, y) = sum of image over [0, x) × [0, y); `integral` is one larger than `image` each way.
// 32 bits hold pictures of up to 16.8 megapixels.
void build_integral(ImageView<const std::uint8_t> image, ImageView<std::uint32_t> integral);

// Sum over [x, x + width) × [y, y + height), which must lie inside the picture. Unsigned wrap-around cancels.
inline std::uint32_t box_sum(ImageView<const std::uint32_t> integral, int x, int y, int width, int height) {
  const std::uint32_t* top = integral.row(y) + x;
  const std::uint32_t* bottom = integral.row(y + height) + x;
  return bottom[width] - bottom[0] - top[width] + top[0];
}

}  // namespace traygauge::paper
