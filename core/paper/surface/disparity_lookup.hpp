// Disparity between pixels of the rectified picture.
#pragma once

#include <array>
#include <cmath>

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge::paper {

// Neighbours that differ by more belong to another surface and are not mixed in: larger smears edges, smaller
// leaves the steps of whole-pixel disparities.
inline constexpr int kMaxLookupStep_px = 1;

// Disparity at a real-valued place: bilinear among the valid ones of the four neighbours that lie on the
// surface of the nearest valid neighbour. False when none is valid or the place lies outside.
inline bool lookup_disparity(ImageView<const Disparity> disparity, double column, double row,
                             double& disparity_px) {
  if (!(column > -0.5 && row > -0.5 && column < disparity.width - 0.5 && row < disparity.height - 0.5)) {
    return false;
  }
  const int left = static_cast<int>(std::floor(column));
  const int top = static_cast<int>(std::floor(row));
  const double right_fraction = column - left;
  const double bottom_fraction = row - top;
  const std::array<double, 4> weights{
      (1.0 - right_fraction) * (1.0 - bottom_fraction), right_fraction * (1.0 - bottom_fraction),
      (1.0 - right_fraction) * bottom_fraction, right_fraction * bottom_fraction};
  std::array<int, 4> values{};
  int nearest = -1;
  for (int k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const int x = left + (k & 1);
    const int y = top + (k >> 1);
    values[i] = disparity.contains(x, y) ? disparity.at(x, y) : kNoDisparity;
    if (values[i] == kNoDisparity) continue;
    if (nearest < 0 || weights[i] > weights[static_cast<std::size_t>(nearest)]) nearest = k;
  }
  if (nearest < 0) return false;

  const int reference = values[static_cast<std::size_t>(nearest)];
  double weighted = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (values[i] == kNoDisparity) continue;
    if (std::abs(values[i] - reference) > kMaxLookupStep_px * kDisparityScale) continue;
    weighted += weights[i] * values[i];
    total += weights[i];
  }
  disparity_px = (total > 0.0 ? weighted / total : reference) / kDisparityScale;
  return true;
}

}  // namespace traygauge::paper
