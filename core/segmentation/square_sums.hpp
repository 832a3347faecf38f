// Sums over the square about each cell of a raster.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace traygauge {

inline constexpr int kMaxSquareRadius = 7;  // a row of the square then fits into a byte many times over

// Of the square that reaches about `radius_mm` from its middle, in cells.
inline int square_radius(double radius_mm, double cell_mm) {
  return std::clamp(static_cast<int>(std::lround(radius_mm / cell_mm)), 1, kMaxSquareRadius);
}

// The fewest of its cells that are `least_fraction` of a square or more.
inline int least_of_square(int radius, double least_fraction) {
  const int side = 2 * radius + 1;
  return static_cast<int>(std::ceil(least_fraction * side * side));
}

// Calls take(x, y, sum) row by row with the sum of value(x, y) over 2 radius + 1 cells each way; cells beyond
// the border are like the nearest. O(cells): running sums along the rows, of which those of 2 radius + 1 rows
// are summed by column. `row_sums` holds a sum of a row for every cell, `column_sums` one for every column.
// No value is read once the first sum has been told, so that `take` may change them.
template <class RowSum, class Value, class Take>
void for_each_square_sum(int width, int height, int radius, std::span<RowSum> row_sums,
                         std::span<std::int32_t> column_sums, Value&& value, Take&& take) {
  const auto row_of = [&](int y) {
    return row_sums.data() + static_cast<std::ptrdiff_t>(y) * static_cast<std::ptrdiff_t>(width);
  };
  for (int y = 0; y < height; ++y) {
    const auto value_at = [&](int x) { return static_cast<int>(value(std::clamp(x, 0, width - 1), y)); };
    RowSum* sums = row_of(y);
    int sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += value_at(x);
    for (int x = 0; x < width; ++x) {
      sums[x] = static_cast<RowSum>(sum);
      sum += value_at(x + radius + 1) - value_at(x - radius);
    }
  }
  const std::span<std::int32_t> columns = column_sums.first(static_cast<std::size_t>(width));
  // Not std::fill: GCC 14 takes the width for negative and warns of a size beyond all memory.
  for (int x = 0; x < width; ++x) columns[static_cast<std::size_t>(x)] = 0;
  const auto add_row = [&](int y, int sign) {
    const RowSum* sums = row_of(std::clamp(y, 0, height - 1));
    for (int x = 0; x < width; ++x) columns[static_cast<std::size_t>(x)] += sign * sums[x];
  };
  for (int y = -radius; y <= radius; ++y) add_row(y, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) take(x, y, columns[static_cast<std::size_t>(x)]);
    add_row(y + radius + 1, 1);
    add_row(y - radius, -1);
  }
}

}  // namespace traygauge
