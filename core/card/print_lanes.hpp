// The print's grey values under four neighbouring pixels at once. Compiler vectors keep the arithmetic equal
// on every processor, and their sums are added lane by lane in one order.
#pragma once

#include <cstdint>

#include "core/base/lanes.hpp"
#include "core/card/card_pattern.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

using IntLanes [[gnu::vector_size(16)]] = std::int32_t;

inline constexpr IntLanes kLaneNumbers = {0, 1, 2, 3};  // of the lanes, in their order

inline FloatLanes to_float(IntLanes values) {
  return __builtin_convertvector(values, FloatLanes);
}

inline double sum_of(FloatLanes values) {
  double sum = 0.0;
  for (int i = 0; i < kFloatLanes; ++i) sum += static_cast<double>(values[i]);
  return sum;
}

// 1 where the bit is set.
inline FloatLanes flags_of(unsigned bits) {
  return to_float(((IntLanes{} + static_cast<std::int32_t>(bits)) >> kLaneNumbers) & 1);
}

inline FloatLanes load_gray(const std::uint8_t* pixels) {
  IntLanes values;
  for (int i = 0; i < kFloatLanes; ++i) values[i] = pixels[i];
  return to_float(values);
}

// Grey values and their slopes along the level's pixels.
struct PrintLanes {
  FloatLanes gray;
  FloatLanes by_x;
  FloatLanes by_y;
};

// Linear interpolation of a level under a tile's pixels, which lie on it in straight even steps.
class PrintSampler {
 public:
  // `centre_mm` lies under the middle of the tile's `side` × `side` pixels.
  PrintSampler(const CardPatternLevel& level, const Vec2& centre_mm, const Eigen::Matrix2d& mm_by_pixel,
               int side)
      : data_(level.gray.data),
        stride_(static_cast<std::int32_t>(level.gray.stride)),
        max_x_(static_cast<float>(level.gray.width) - 1.001F),
        max_y_(static_cast<float>(level.gray.height) - 1.001F) {
    const Eigen::Matrix2d step = level.px_per_mm().asDiagonal() * mm_by_pixel;
    const Vec2 centre = (level.px_per_mm().cwiseProduct(centre_mm).array() - 0.5).matrix();
    const Vec2 first = centre - step * Vec2::Constant(0.5 * (side - 1));
    x_by_column_ = static_cast<float>(step(0, 0));
    x_by_row_ = static_cast<float>(step(0, 1));
    y_by_column_ = static_cast<float>(step(1, 0));
    y_by_row_ = static_cast<float>(step(1, 1));
    x_ = static_cast<float>(first.x()) + to_float(kLaneNumbers) * x_by_column_;
    y_ = static_cast<float>(first.y()) + to_float(kLaneNumbers) * y_by_column_;
  }

  // Under the pixels from `column` on.
  PrintLanes at(int column, int row) const {
    const auto along = static_cast<float>(column);
    const auto down = static_cast<float>(row);
    const FloatLanes x = clamped(x_ + (along * x_by_column_ + down * x_by_row_), max_x_);
    const FloatLanes y = clamped(y_ + (along * y_by_column_ + down * y_by_row_), max_y_);
    const IntLanes left = __builtin_convertvector(x, IntLanes);
    const IntLanes top = __builtin_convertvector(y, IntLanes);
    const FloatLanes fx = x - to_float(left);
    const FloatLanes fy = y - to_float(top);
    const IntLanes places = top * stride_ + left;
    IntLanes a;
    IntLanes b;
    IntLanes c;
    IntLanes d;
    for (int i = 0; i < kFloatLanes; ++i) {
      const std::uint8_t* upper = data_ + places[i];
      a[i] = upper[0];
      b[i] = upper[1];
      c[i] = upper[stride_];
      d[i] = upper[stride_ + 1];
    }
    const FloatLanes across_above = to_float(b - a);
    const FloatLanes across_below = to_float(d - c);
    const FloatLanes above = to_float(a) + fx * across_above;
    const FloatLanes below = to_float(c) + fx * across_below;
    return {above + fy * (below - above), across_above + fy * (across_below - across_above), below - above};
  }

 private:
  // Also turns what is not a number into 0.
  static FloatLanes clamped(FloatLanes values, float most) {
    const FloatLanes upper = FloatLanes{} + most;
    values = values < upper ? values : upper;
    return values > 0.0F ? values : FloatLanes{};
  }

  const std::uint8_t* data_;
  std::int32_t stride_;
  float max_x_;
  float max_y_;
  float x_by_column_ = 0.0F;
  float x_by_row_ = 0.0F;
  float y_by_column_ = 0.0F;
  float y_by_row_ = 0.0F;
  FloatLanes x_;
  FloatLanes y_;
};

}  // namespace traygauge
