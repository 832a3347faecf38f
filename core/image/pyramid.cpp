#include "core/image/pyramid.hpp"

#include <algorithm>

namespace traygauge {
namespace {

// Calls combine(a, b, c, d) for every 2 × 2 pixels; an odd last row or column is repeated.
template <class Combine>
void halve_with(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target, Combine combine) {
  const int pairs = source.width / 2;
  for (int y = 0; y < target.height; ++y) {
    const std::uint8_t* upper = source.row(2 * y);
    const std::uint8_t* lower = source.row(std::min(2 * y + 1, source.height - 1));
    std::uint8_t* out = target.row(y);
    for (int x = 0; x < pairs; ++x) {
      const std::uint8_t* top = upper + std::ptrdiff_t{2} * x;
      const std::uint8_t* bottom = lower + std::ptrdiff_t{2} * x;
      out[x] = combine(top[0], top[1], bottom[0], bottom[1]);
    }
    if (pairs < target.width) {
      const int last = source.width - 1;
      out[pairs] = combine(upper[last], upper[last], lower[last], lower[last]);
    }
  }
}

}  // namespace

void halve(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) {
  halve_with(source, target, [](unsigned a, unsigned b, unsigned c, unsigned d) {
    return static_cast<std::uint8_t>((a + b + c + d + 2U) / 4U);
  });
}

void halve_mask(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) {
  halve_with(source, target, [](std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
    const int set = (a != 0 ? 1 : 0) + (b != 0 ? 1 : 0) + (c != 0 ? 1 : 0) + (d != 0 ? 1 : 0);
    return set >= 2 ? std::max(std::max(a, b), std::max(c, d)) : std::uint8_t{0};
  });
}

}  // namespace traygauge
