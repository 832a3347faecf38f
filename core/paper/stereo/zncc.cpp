#include "core/paper/stereo/zncc.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge::paper {
namespace {

// Pixels are taken relative to mid-grey, so that products fit 16 bits and window sums 32.
constexpr int kMidGrey = 128;
constexpr int kFirstZnccRow = -kFirstPixelRow;  // of the block, within a PixelColumn

const PixelColumn& column_at(const BlockPicture& picture, int x) {
  return picture.pixels[static_cast<std::size_t>(std::clamp(x, 0, picture.width - 1))];
}

void take_moments(const BlockPicture& picture, int radius_px, std::span<WindowMoments> moments) {
  const int area = (2 * radius_px + 1) * (2 * radius_px + 1);
  for (int x = 0; x < picture.width; ++x) {
    std::int32_t sum[kRowLanes] = {};
    std::int32_t squares[kRowLanes] = {};
    for (int dx = -radius_px; dx <= radius_px; ++dx) {
      const PixelColumn& column = column_at(picture, x + dx);
      for (int dy = -radius_px; dy <= radius_px; ++dy) {
        for (int r = 0; r < kRowLanes; ++r) {
          const int pixel = column.row[kFirstZnccRow + r + dy] - kMidGrey;
          sum[r] += pixel;
          squares[r] += pixel * pixel;
        }
      }
    }
    WindowMoments& window = moments[static_cast<std::size_t>(x)];
    for (int r = 0; r < kRowLanes; ++r) {
      const int variation = area * squares[r] - sum[r] * sum[r];
      window.sum[r] = sum[r];
      window.inverse_deviation[r] = variation > 0 ? 1.0F / std::sqrt(static_cast<float>(variation)) : 0.0F;
    }
  }
}

void sum_products(const MatchingBlock& block, int x, int d, int radius_px, WindowProducts& products) {
  products = {};
  for (int dx = -radius_px; dx <= radius_px; ++dx) {
    const PixelColumn& first = column_at(block.first, x + dx);
    const PixelColumn& second = column_at(block.second, x + dx + d);
    for (int dy = -radius_px; dy <= radius_px; ++dy) {
      for (int r = 0; r < kRowLanes; ++r) {
        const int row = kFirstZnccRow + r + dy;
        products.sum[r] += (first.row[row] - kMidGrey) * (second.row[row] - kMidGrey);
      }
    }
  }
}

}  // namespace

void prepare_correlation(const MatchingBlock& block, int radius_px, CorrelationWorkspace& workspace) {
  take_moments(block.first, radius_px, workspace.first);
  take_moments(block.second, radius_px, workspace.second);
}

void correlation_costs(const MatchingBlock& block, int x, Interval interval, const StereoParams& params,
                       CorrelationWorkspace& workspace, CostLanes* costs) {
  const int radius = params.window_radius_px;
  const int area = (2 * radius + 1) * (2 * radius + 1);
  const auto weight = static_cast<float>(params.zncc_weight * area);
  const WindowMoments& first = workspace.first[static_cast<std::size_t>(x)];
  const ByteLanes wanted = block.first.inside[static_cast<std::size_t>(x)];
  for (int d = interval.lo; d <= interval.hi; ++d, ++costs) {
    const int partner = x + d;
    const bool exists = partner >= 0 && partner < block.second.width;
    const auto column = static_cast<std::size_t>(exists ? partner : 0);
    const ByteLanes inside = exists ? block.second.inside[column] : ByteLanes{};
    const WindowMoments& second = workspace.second[column];
    WindowProducts products{};
    if (exists) sum_products(block, x, d, radius, products);
    for (int r = 0; r < kRowLanes; ++r) {
      const auto covariation = static_cast<float>(area * products.sum[r] - first.sum[r] * second.sum[r]);
      const float correlation = covariation * first.inverse_deviation[r] * second.inverse_deviation[r];
      const bool compared = inside[r + kMaxWindowRadius] != 0;
      const float cost = compared ? weight * (1.0F - correlation) : 2.0F * weight;
      (*costs)[r] =
          wanted[r + kMaxWindowRadius] != 0 ? static_cast<std::int16_t>(cost + 0.5F) : std::int16_t{0};
    }
  }
}

}  // namespace traygauge::paper
