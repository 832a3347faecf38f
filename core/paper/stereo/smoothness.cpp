#include "core/paper/stereo/smoothness.hpp"

#include <algorithm>

namespace traygauge::paper {
namespace {

constexpr int kFirstRow = -kFirstPixelRow;  // of the block, within a PixelColumn

constexpr float kHighestCost = 8000.0F;  // as much as find_best_paths() takes for one pixel

// Sums over the window's rows of one column, for each row of the block.
struct ColumnMoments {
  std::int32_t sum[kRowLanes] = {};
  std::int32_t squares[kRowLanes] = {};
};

void accumulate(const PixelColumn& column, int radius_px, std::int32_t sign, ColumnMoments& moments) {
  for (int dy = -radius_px; dy <= radius_px; ++dy) {
    for (int r = 0; r < kRowLanes; ++r) {
      const std::int32_t pixel = column.row[kFirstRow + r + dy];
      moments.sum[r] += sign * pixel;
      moments.squares[r] += sign * pixel * pixel;
    }
  }
}

}  // namespace

void smoothness_costs(const BlockPicture& picture, const StereoParams& params, std::span<CostLanes> costs) {
  const int radius = params.variance_radius_px;
  const int window = 2 * params.window_radius_px + 1;
  const auto highest = static_cast<float>(params.smoothness * window * window);
  const auto area = static_cast<float>((2 * radius + 1) * (2 * radius + 1));
  const auto halving = static_cast<float>(params.smoothness_deviation * params.smoothness_deviation);
  const auto column_at = [&](int x) -> const PixelColumn& {
    return picture.pixels[static_cast<std::size_t>(std::clamp(x, 0, picture.width - 1))];
  };
  ColumnMoments moments;
  for (int dx = -radius; dx <= radius; ++dx) accumulate(column_at(dx), radius, 1, moments);
  for (int x = 0; x < picture.width; ++x) {
    CostLanes& cost = costs[static_cast<std::size_t>(x)];
    for (int r = 0; r < kRowLanes; ++r) {
      const float mean = static_cast<float>(moments.sum[r]) / area;
      const float variance = static_cast<float>(moments.squares[r]) / area - mean * mean;
      const float falling = highest * halving / (halving + std::max(variance, 0.0F));
      cost[r] = static_cast<std::int16_t>(std::clamp(falling, 1.0F, kHighestCost));
    }
    accumulate(column_at(x - radius), radius, -1, moments);
    accumulate(column_at(x + radius + 1), radius, 1, moments);
  }
}

}  // namespace traygauge::paper
