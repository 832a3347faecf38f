#include "core/volume/foot_height.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

constexpr int kReach = 3;  // samples; those nearest to the edge show either side
constexpr std::uint32_t kMinSamples = 30;
constexpr double kLowestMm = -20.0;
constexpr double kBinMm = 0.25;
constexpr std::size_t kBins = 160;
constexpr double kQuantile = 0.25;

bool is_beside(const ImageView<const std::uint8_t>& labels, int x, int y, std::uint8_t dish) {
  const auto is_dish = [&](int column, int row) {
    return labels.contains(column, row) && labels.at(column, row) == dish;
  };
  return is_dish(x - kReach, y) || is_dish(x + kReach, y) || is_dish(x, y - kReach) || is_dish(x, y + kReach);
}

std::optional<double> foot_in_view(const SurfaceGrid& view, const InnerSurface& inner, std::uint8_t item,
                                   std::uint8_t dish) {
  std::array<std::uint32_t, kBins> histogram{};
  std::uint32_t count = 0;
  for (int y = 0; y < view.labels.height; ++y) {
    for (int x = 0; x < view.labels.width; ++x) {
      if (view.labels.at(x, y) != item || view.evidence.at(x, y) != SurfaceEvidence::both) continue;
      if (!is_beside(view.labels, x, y, dish)) continue;
      const SurfacePoint& point = view.points.at(x, y);
      const double height_mm = point.z_mm - inner.height_mm(Vec2(point.x_mm, point.y_mm));
      const double bin = std::clamp((height_mm - kLowestMm) / kBinMm, 0.0, static_cast<double>(kBins - 1));
      ++histogram[static_cast<std::size_t>(bin)];
      ++count;
    }
  }
  if (count < kMinSamples) return std::nullopt;
  std::uint32_t below = 0;
  std::size_t bin = 0;
  while (bin + 1 < kBins && below + histogram[bin] <= kQuantile * count) below += histogram[bin++];
  return kLowestMm + (static_cast<double>(bin) + 0.5) * kBinMm;
}

}  // namespace

std::optional<double> foot_height_mm(const std::array<SurfaceGrid, 2>& views, const InnerSurface& inner,
                                     std::uint8_t item, std::uint8_t dish) {
  const std::optional<double> first = foot_in_view(views[0], inner, item, dish);
  const std::optional<double> second = foot_in_view(views[1], inner, item, dish);
  return first && second ? std::optional(std::min(*first, *second)) : first ? first : second;
}

}  // namespace traygauge
