#include "core/paper/image/integral.hpp"

#include <algorithm>

namespace traygauge::paper {

void build_integral(ImageView<const std::uint8_t> image, ImageView<std::uint32_t> integral) {
  std::fill_n(integral.row(0), image.width + 1, 0U);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* pixels = image.row(y);
    const std::uint32_t* above = integral.row(y);
    std::uint32_t* sums = integral.row(y + 1);
    std::uint32_t row_sum = 0;
    sums[0] = 0;
    for (int x = 0; x < image.width; ++x) {
      row_sum += pixels[x];
      sums[x + 1] = above[x + 1] + row_sum;
    }
  }
}

}  // namespace traygauge::paper
