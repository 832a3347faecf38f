#include <algorithm>
#include <array>

#include "core/base/lanes.hpp"
#include "core/image/resample.hpp"

namespace traygauge {
namespace {

// A target edge lies at edge · source / target of the source: whole pixels, and a rest in 1 / target pixels.
// Everything stays an integer, so that the average is exact.
struct Edge {
  int pixel = 0;
  std::uint32_t rest = 0;
};

Edge edge_at(int index, int source_size, int target_size) {
  const std::int64_t position = static_cast<std::int64_t>(index) * source_size;
  return {static_cast<int>(position / target_size), static_cast<std::uint32_t>(position % target_size)};
}

using ColumnSums = std::array<std::uint32_t, kRowBlock + 1>;

// The product of two numbers of 16 bits is one for the vectoriser.
void add_row(const std::uint8_t* __restrict pixels, std::uint16_t weight, int count,
             std::uint32_t* __restrict sums) {
  for (int i = 0; i < count; ++i) {
    const std::uint16_t pixel = pixels[i];
    sums[i] += std::uint32_t{pixel} * std::uint32_t{weight};
  }
}

// Weighted sum of each source column over one target row, weights in 1 / target.height of a source pixel.
void sum_columns(ImageView<const std::uint8_t> source, Edge top, Edge bottom, std::uint32_t unit, int left,
                 int count, ColumnSums& sums) {
  sums.fill(0);
  for (int y = top.pixel; y <= std::min(bottom.pixel, source.height - 1); ++y) {
    const std::uint32_t end = y == bottom.pixel ? bottom.rest : unit;
    const std::uint32_t begin = y == top.pixel ? top.rest : 0U;
    if (end > begin)
      add_row(source.row(y) + left, static_cast<std::uint16_t>(end - begin), count, sums.data());
  }
}

}  // namespace

void reduce_area(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) {
  const auto unit_x = static_cast<std::uint32_t>(target.width);
  const auto unit_y = static_cast<std::uint32_t>(target.height);
  const double area = static_cast<double>(source.width) * source.height;  // of a target pixel, in those units
  const double half = 0.5 * area;
  const Edge step = edge_at(1, source.width, target.width);
  ColumnSums sums;
  for (int row = 0; row < target.height; ++row) {
    const Edge top = edge_at(row, source.height, target.height);
    const Edge bottom = edge_at(row + 1, source.height, target.height);
    std::uint8_t* out = target.row(row);
    Edge edge = step;
    int column = 0;
    std::uint32_t running = 0;   // sum of the whole columns so far; wrap-around cancels in the difference
    std::uint32_t previous = 0;  // weighted sum up to the previous edge
    for (int left = 0; left < source.width; left += kRowBlock) {
      const int count = std::min(kRowBlock, source.width - left);
      sum_columns(source, top, bottom, unit_y, left, count, sums);
      const int end = left + count;
      int x = left;
      while (column < target.width && (edge.pixel < end || end == source.width)) {
        for (; x < edge.pixel; ++x) running += sums[static_cast<std::size_t>(x - left)];
        const std::uint32_t up_to = unit_x * running + edge.rest * sums[static_cast<std::size_t>(x - left)];
        out[column++] = static_cast<std::uint8_t>((up_to - previous + half) / area);
        previous = up_to;
        edge.pixel += step.pixel;
        edge.rest += step.rest;
        if (edge.rest >= unit_x) {
          edge.rest -= unit_x;
          ++edge.pixel;
        }
      }
      for (; x < end; ++x) running += sums[static_cast<std::size_t>(x - left)];
    }
  }
}

}  // namespace traygauge
