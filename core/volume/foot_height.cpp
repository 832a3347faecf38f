#include "core/volume/foot_height.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

// By reason, tried on slips-10 of seed 71.
constexpr int kFootReach = 3;  // samples; those nearest to the edge show either side
constexpr std::uint32_t kMinFootSamples = 30;
constexpr double kLowestFootMm = -20.0;  // of a histogram up to +20 mm, finer than what is warned of
constexpr double kFootBinMm = 0.25;
constexpr std::size_t kFootBins = 160;
constexpr double kFootQuantile = 0.25;  // holds while fewer than a quarter are matched wrongly to below

bool is_beside(const ImageView<const std::uint8_t>& labels, int x, int y) {
  const auto is_dish = [&](int column, int row) {
    return labels.contains(column, row) && labels.at(column, row) == kDishLabel;
  };
  return is_dish(x - kFootReach, y) || is_dish(x + kFootReach, y) || is_dish(x, y - kFootReach) ||
         is_dish(x, y + kFootReach);
}

std::optional<double> foot_in_view(const SurfaceGrid& view, const InnerSurface& inner, std::uint8_t item) {
  std::array<std::uint32_t, kFootBins> histogram{};
  std::uint32_t count = 0;
  for (int y = 0; y < view.labels.height; ++y) {
    for (int x = 0; x < view.labels.width; ++x) {
      if (view.labels.at(x, y) != item || view.evidence.at(x, y) != SurfaceEvidence::both) continue;
      if (!is_beside(view.labels, x, y)) continue;
      const SurfacePoint& point = view.points.at(x, y);
      const double height_mm = point.z_mm - inner.height_mm(Vec2(point.x_mm, point.y_mm));
      const double bin =
          std::clamp((height_mm - kLowestFootMm) / kFootBinMm, 0.0, static_cast<double>(kFootBins - 1));
      ++histogram[static_cast<std::size_t>(bin)];
      ++count;
    }
  }
  if (count < kMinFootSamples) return std::nullopt;
  std::uint32_t below = 0;
  std::size_t bin = 0;
  while (bin + 1 < kFootBins && below + histogram[bin] <= kFootQuantile * count) below += histogram[bin++];
  return kLowestFootMm + (static_cast<double>(bin) + 0.5) * kFootBinMm;
}

}  // namespace

std::optional<double> foot_height_mm(const std::array<SurfaceGrid, 2>& views, const InnerSurface& inner,
                                     std::uint8_t item) {
  const std::optional<double> first = foot_in_view(views[0], inner, item);
  const std::optional<double> second = foot_in_view(views[1], inner, item);
  return first && second ? std::optional(std::min(*first, *second)) : first ? first : second;
}

}  // namespace traygauge
