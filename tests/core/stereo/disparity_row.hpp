// Rows of disparities that tests write out.
#pragma once

#include <vector>

#include "core/stereo/disparity.hpp"

namespace traygauge::test {

inline constexpr Disparity kNone = kNoDisparity;
using DisparityRow = std::vector<Disparity>;

constexpr Disparity px(double disparity_px) {
  return static_cast<Disparity>(disparity_px * kDisparityScale);
}

}  // namespace traygauge::test
