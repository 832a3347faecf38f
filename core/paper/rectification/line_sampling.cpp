#include "core/paper/rectification/line_sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace traygauge::paper {
namespace {

using Fixed = std::int64_t;  // 32 fractional bits: 1000 increments are off by less than 1e-6 px
constexpr int kFixedBits = 32;
constexpr int kWeightBits = 8;
constexpr int kWeightOne = 1 << kWeightBits;

Fixed to_fixed(double value) {
  return static_cast<Fixed>(std::floor(value * static_cast<double>(Fixed{1} << kFixedBits) + 0.5));
}

// Rounds to `Bits` fractional bits.
template <int Bits>
constexpr Fixed quantize(Fixed value) {
  constexpr int kShift = kFixedBits - Bits;
  return (value + (Fixed{1} << (kShift - 1))) >> kShift;
}

// A walk along the columns [first, last) of a line, whose quantised positions all lie in the picture.
template <int Bits>
struct LineWalk {
  int first = 0;
  int last = 0;
  std::array<Fixed, 2> position{};
  std::array<Fixed, 2> step{};

  LineWalk(const RectifiedLine& line, int columns, int width, int height) {
    // Half a quantum beyond the outer pixel centres still rounds into the picture.
    constexpr double kSlack = 0.5 / (1 << Bits);
    double low = 0.0;
    double high = columns - 1.0;
    const std::array sizes = {width, height};
    for (int axis = 0; axis < 2; ++axis) {
      const double size = sizes[static_cast<std::size_t>(axis)] - 1.0;
      const double slope = line.step[axis];
      if (slope == 0.0) {
        if (line.origin[axis] < -kSlack || line.origin[axis] > size + kSlack) high = -1.0;
        continue;
      }
      const double one = (-kSlack - line.origin[axis]) / slope;
      const double other = (size + kSlack - line.origin[axis]) / slope;
      low = std::max(low, std::min(one, other));
      high = std::min(high, std::max(one, other));
    }
    if (!(low <= high)) return;
    first = static_cast<int>(std::ceil(low));
    last = static_cast<int>(std::floor(high)) + 1;
    const Vec2 start = line.pixel(first);
    position = {to_fixed(start.x()), to_fixed(start.y())};
    step = {to_fixed(line.step.x()), to_fixed(line.step.y())};
    trim(width, height);
  }

  // Rounding can push the two ends out by a hair.
  void trim(int width, int height) {
    const Fixed limit_x = static_cast<Fixed>(width - 1) << Bits;
    const Fixed limit_y = static_cast<Fixed>(height - 1) << Bits;
    const auto inside = [&](Fixed column) {
      const Fixed x = quantize<Bits>(position[0] + column * step[0]);
      const Fixed y = quantize<Bits>(position[1] + column * step[1]);
      return x >= 0 && y >= 0 && x <= limit_x && y <= limit_y;
    };
    while (first < last && !inside(last - 1 - first)) --last;
    while (first < last && !inside(0)) advance(), ++first;
  }

  void advance() {
    position[0] += step[0];
    position[1] += step[1];
  }
};

}  // namespace

void sample_line_bilinear(ImageView<const std::uint8_t> source, const RectifiedLine& line,
                          std::span<std::uint8_t> target) {
  LineWalk<kWeightBits> walk(line, static_cast<int>(target.size()), source.width, source.height);
  std::fill_n(target.begin(), walk.first, std::uint8_t{0});
  for (int column = walk.first; column < walk.last; ++column, walk.advance()) {
    const auto x = static_cast<int>(quantize<kWeightBits>(walk.position[0]));
    const auto y = static_cast<int>(quantize<kWeightBits>(walk.position[1]));
    const int left = x >> kWeightBits;
    const int top = y >> kWeightBits;
    const int right_weight = x & (kWeightOne - 1);
    const int bottom_weight = y & (kWeightOne - 1);
    // The last row and column have no neighbour and need none: their weight is 0.
    const int right_step = left + 1 < source.width ? 1 : 0;
    const std::uint8_t* above = source.row(top) + left;
    const std::uint8_t* below = above + (top + 1 < source.height ? source.stride : 0);
    const int upper = above[0] * kWeightOne + (above[right_step] - above[0]) * right_weight;
    const int lower = below[0] * kWeightOne + (below[right_step] - below[0]) * right_weight;
    const int sum = upper * kWeightOne + (lower - upper) * bottom_weight;
    target[static_cast<std::size_t>(column)] =
        static_cast<std::uint8_t>((sum + (1 << (2 * kWeightBits - 1))) >> (2 * kWeightBits));
  }
  std::fill(target.begin() + walk.last, target.end(), std::uint8_t{0});
}

void sample_line_nearest(ImageView<const std::uint8_t> source, const RectifiedLine& line,
                         std::span<std::uint8_t> target) {
  LineWalk<0> walk(line, static_cast<int>(target.size()), source.width, source.height);
  std::fill_n(target.begin(), walk.first, std::uint8_t{0});
  for (int column = walk.first; column < walk.last; ++column, walk.advance()) {
    const auto x = static_cast<int>(quantize<0>(walk.position[0]));
    const auto y = static_cast<int>(quantize<0>(walk.position[1]));
    target[static_cast<std::size_t>(column)] = source.at(x, y);
  }
  std::fill(target.begin() + walk.last, target.end(), std::uint8_t{0});
}

}  // namespace traygauge::paper
