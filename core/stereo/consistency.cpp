#include "core/stereo/consistency.hpp"

#include <cmath>

namespace traygauge {

void keep_consistent(ImageView<const Disparity> own, ImageView<const Disparity> other, int sign,
                     ImageView<Disparity> kept) {
  constexpr int kMost = kDisparityScale + kDisparityScale / 2;  // a whole pixel, and half a step
  for (int y = 0; y < own.height; ++y) {
    for (int x = 0; x < own.width; ++x) {
      const int d = own.at(x, y);
      kept.at(x, y) = kNoDisparity;
      if (d == kNoDisparity) continue;
      const int partner = x + sign * whole_px(d);
      if (partner < 0 || partner >= other.width) continue;
      const int back = other.at(partner, y);
      if (back != kNoDisparity && std::abs(back - d) <= kMost) kept.at(x, y) = static_cast<Disparity>(d);
    }
  }
}

}  // namespace traygauge
