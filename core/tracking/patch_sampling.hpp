// Square patches of a picture, sampled through an affine map.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr int kPatchUnit = 16;  // four bits beside the eight of a grey value

// Grey values times kPatchUnit at centre + map · (i − ½(side − 1), j − ½(side − 1)), bilinear with fractions
// of 1/128 px, row by row into `values`. False where the patch leaves the picture.
template <int kSide>
bool sample_patch(ImageView<const std::uint8_t> gray, const Vec2& centre, const Eigen::Matrix2d& map,
                  std::int16_t* values) {
  constexpr double kReach = 0.5 * (kSide - 1);
  constexpr double kOne = 65536.0;  // of the fixed-point coordinates
  const double reach_x = kReach * (std::abs(map(0, 0)) + std::abs(map(0, 1)));
  const double reach_y = kReach * (std::abs(map(1, 0)) + std::abs(map(1, 1)));
  // One pixel beyond the last sample is read, and roundings must stay inside as well.
  if (!(centre.x() - reach_x >= 1.0 && centre.y() - reach_y >= 1.0 &&
        centre.x() + reach_x <= gray.width - 3.0 && centre.y() + reach_y <= gray.height - 3.0)) {
    return false;
  }
  const Vec2 corner = centre - kReach * (map.col(0) + map.col(1));
  const auto step_x = static_cast<std::int32_t>(std::lround(map(0, 0) * kOne));
  const auto step_y = static_cast<std::int32_t>(std::lround(map(1, 0) * kOne));
  for (int j = 0; j < kSide; ++j) {
    const Vec2 first = corner + j * map.col(1);
    auto x = static_cast<std::int32_t>(std::lround(first.x() * kOne)) + 256;  // half of the fractions' unit
    auto y = static_cast<std::int32_t>(std::lround(first.y() * kOne)) + 256;
    for (int i = 0; i < kSide; ++i, x += step_x, y += step_y) {
      const std::uint8_t* upper = gray.row(y >> 16) + (x >> 16);
      const std::uint8_t* lower = upper + gray.stride;
      const int fx = (x >> 9) & 127;
      const int fy = (y >> 9) & 127;
      const int top = 128 * upper[0] + fx * (upper[1] - upper[0]);
      const int bottom = 128 * lower[0] + fx * (lower[1] - lower[0]);
      *values++ = static_cast<std::int16_t>((128 * top + fy * (bottom - top) + 512) >> 10);
    }
  }
  return true;
}

}  // namespace traygauge
