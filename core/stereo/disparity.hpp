// Disparity pictures. disparity = column in the second rectified picture − column in the first.
#pragma once

#include <cstdint>
#include <limits>

namespace traygauge {

using Disparity = std::int16_t;             // in sixteenths of a pixel
inline constexpr int kDisparityScale = 16;  // whole steps of 16 bits then reach ±2046 px
inline constexpr Disparity kNoDisparity = std::numeric_limits<Disparity>::min();

inline constexpr int kMaxDisparityPx =
    std::numeric_limits<Disparity>::max() / kDisparityScale - 1;  // either sign

// Neighbours, and ends of a gap, that differ by less are one surface.
inline constexpr double kOneSurfacePx = 5.0;

// To the nearest pixel.
constexpr int whole_px(int disparity) {
  return (disparity + kDisparityScale / 2) >> 4;
}
static_assert(kDisparityScale == 16);

// Inclusive, in whole pixels.
struct DisparityRange {
  int min_px = 0;
  int max_px = 0;
  constexpr int count() const { return max_px - min_px + 1; }
};

}  // namespace traygauge
