#include "core/paper/image/enlarge.hpp"

#include <algorithm>
#include <cmath>

#include "core/image/resample.hpp"

namespace traygauge::paper {
namespace {

// The two source pixels beside a target coordinate, and the weight of the latter in 256ths.
struct SourcePair {
  int low = 0;
  int high = 0;
  int weight = 0;
};

constexpr int kOne = 256;

SourcePair neighbours(int target, double scale, int source_size) {
  const double place = std::clamp(scale_coordinate(target, scale), 0.0, source_size - 1.0);
  const int low = static_cast<int>(place);
  return {low, std::min(low + 1, source_size - 1), static_cast<int>(std::lround((place - low) * kOne))};
}

}  // namespace

void enlarge(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target) {
  const double scale_x = static_cast<double>(source.width) / target.width;
  const double scale_y = static_cast<double>(source.height) / target.height;
  for (int y = 0; y < target.height; ++y) {
    const SourcePair rows = neighbours(y, scale_y, source.height);
    const std::uint8_t* upper = source.row(rows.low);
    const std::uint8_t* lower = source.row(rows.high);
    std::uint8_t* out = target.row(y);
    for (int x = 0; x < target.width; ++x) {
      const SourcePair columns = neighbours(x, scale_x, source.width);
      const int top = upper[columns.low] * (kOne - columns.weight) + upper[columns.high] * columns.weight;
      const int bottom = lower[columns.low] * (kOne - columns.weight) + lower[columns.high] * columns.weight;
      const int sum = top * (kOne - rows.weight) + bottom * rows.weight;
      out[x] = static_cast<std::uint8_t>((sum + kOne * kOne / 2) / (kOne * kOne));
    }
  }
}

}  // namespace traygauge::paper
