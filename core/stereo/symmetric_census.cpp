#include "core/stereo/symmetric_census.hpp"

#include <algorithm>
#include <array>

namespace traygauge {
namespace {

constexpr int kReach = kSymmetricCensusColumns;
constexpr int kRows = 2 * kSymmetricCensusRows + 1;
using Rows = std::array<const std::uint8_t*, kRows>;

// What a bit says about two pixels opposite each other, and the pixel between them.
struct IsGreater {
  std::uint32_t operator()(std::uint8_t a, std::uint8_t b, std::uint8_t) const { return a > b ? 1U : 0U; }
};
struct IsAlike {
  std::uint32_t operator()(std::uint8_t a, std::uint8_t b, std::uint8_t centre) const {
    return static_cast<std::uint32_t>(a == centre) & static_cast<std::uint32_t>(b == centre);
  }
};

// The columns [first, last) of a row whose windows lie inside the picture.
template <class Bit>
void transform_inside(const Rows& rows, int first, int last, std::uint32_t* codes) {
  const std::uint8_t* middle = rows[kSymmetricCensusRows];
  for (int x = first; x < last; ++x) codes[x] = 0;
  for (int dy = 0; dy <= kSymmetricCensusRows; ++dy) {
    const std::uint8_t* upper = rows[static_cast<std::size_t>(kSymmetricCensusRows - dy)];
    const std::uint8_t* lower = rows[static_cast<std::size_t>(kSymmetricCensusRows + dy)];
    for (int dx = dy == 0 ? 1 : -kReach; dx <= kReach; ++dx) {
      for (int x = first; x < last; ++x) {
        codes[x] = (codes[x] << 1) | Bit{}(lower[x + dx], upper[x - dx], middle[x]);
      }
    }
  }
}

// The same for one column, with its neighbours clamped.
template <class Bit>
std::uint32_t transform_at_border(const Rows& rows, int x, int width) {
  const std::uint8_t* middle = rows[kSymmetricCensusRows];
  std::uint32_t code = 0;
  for (int dy = 0; dy <= kSymmetricCensusRows; ++dy) {
    const std::uint8_t* upper = rows[static_cast<std::size_t>(kSymmetricCensusRows - dy)];
    const std::uint8_t* lower = rows[static_cast<std::size_t>(kSymmetricCensusRows + dy)];
    for (int dx = dy == 0 ? 1 : -kReach; dx <= kReach; ++dx) {
      const std::uint8_t a = lower[std::clamp(x + dx, 0, width - 1)];
      const std::uint8_t b = upper[std::clamp(x - dx, 0, width - 1)];
      code = (code << 1) | Bit{}(a, b, middle[x]);
    }
  }
  return code;
}

template <class Bit>
void transform(ImageView<const std::uint8_t> picture, ImageView<std::uint32_t> codes) {
  for (int y = 0; y < picture.height; ++y) {
    Rows rows;
    for (int i = 0; i < kRows; ++i) {
      rows[static_cast<std::size_t>(i)] =
          picture.row(std::clamp(y + i - kSymmetricCensusRows, 0, picture.height - 1));
    }
    const int first = std::min(kReach, picture.width);
    const int last = std::max(first, picture.width - kReach);
    for (int x = 0; x < first; ++x) codes.at(x, y) = transform_at_border<Bit>(rows, x, picture.width);
    transform_inside<Bit>(rows, first, last, codes.row(y));
    for (int x = last; x < picture.width; ++x)
      codes.at(x, y) = transform_at_border<Bit>(rows, x, picture.width);
  }
}

}  // namespace

void transform_symmetric_census(ImageView<const std::uint8_t> picture, ImageView<std::uint32_t> codes) {
  transform<IsGreater>(picture, codes);
}

void mask_symmetric_census(ImageView<const std::uint8_t> labels, ImageView<std::uint32_t> masks) {
  transform<IsAlike>(labels, masks);
}

}  // namespace traygauge
