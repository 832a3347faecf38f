#include "core/stereo/symmetric_census.hpp"

#include <algorithm>
#include <array>

namespace traygauge {
namespace {

constexpr int kReach = kSymmetricCensusColumns;
constexpr int kRows = 2 * kSymmetricCensusRows + 1;
using Rows = std::array<const std::uint8_t*, kRows>;

// The columns [first, last) of a row whose windows lie inside the picture.
void transform_inside(const Rows& rows, int first, int last, std::uint32_t* codes) {
  for (int x = first; x < last; ++x) codes[x] = 0;
  for (int dy = 0; dy <= kSymmetricCensusRows; ++dy) {
    const std::uint8_t* upper = rows[static_cast<std::size_t>(kSymmetricCensusRows - dy)];
    const std::uint8_t* lower = rows[static_cast<std::size_t>(kSymmetricCensusRows + dy)];
    for (int dx = dy == 0 ? 1 : -kReach; dx <= kReach; ++dx) {
      for (int x = first; x < last; ++x) {
        codes[x] = (codes[x] << 1) | static_cast<std::uint32_t>(lower[x + dx] > upper[x - dx]);
      }
    }
  }
}

// The same for one column, with its neighbours clamped.
std::uint32_t transform_at_border(const Rows& rows, int x, int width) {
  std::uint32_t code = 0;
  for (int dy = 0; dy <= kSymmetricCensusRows; ++dy) {
    const std::uint8_t* upper = rows[static_cast<std::size_t>(kSymmetricCensusRows - dy)];
    const std::uint8_t* lower = rows[static_cast<std::size_t>(kSymmetricCensusRows + dy)];
    for (int dx = dy == 0 ? 1 : -kReach; dx <= kReach; ++dx) {
      const std::uint8_t a = lower[std::clamp(x + dx, 0, width - 1)];
      const std::uint8_t b = upper[std::clamp(x - dx, 0, width - 1)];
      code = (code << 1) | static_cast<std::uint32_t>(a > b);
    }
  }
  return code;
}

}  // namespace

void transform_symmetric_census(ImageView<const std::uint8_t> picture, ImageView<std::uint32_t> codes) {
  for (int y = 0; y < picture.height; ++y) {
    Rows rows;
    for (int i = 0; i < kRows; ++i) {
      rows[static_cast<std::size_t>(i)] =
          picture.row(std::clamp(y + i - kSymmetricCensusRows, 0, picture.height - 1));
    }
    const int first = std::min(kReach, picture.width);
    const int last = std::max(first, picture.width - kReach);
    for (int x = 0; x < first; ++x) codes.at(x, y) = transform_at_border(rows, x, picture.width);
    transform_inside(rows, first, last, codes.row(y));
    for (int x = last; x < picture.width; ++x) codes.at(x, y) = transform_at_border(rows, x, picture.width);
  }
}

}  // namespace traygauge
