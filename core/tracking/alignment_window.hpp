// The second picture's patch at a fraction of a pixel, bilinear.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/lanes.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "core/tracking/alignment_equations.hpp"

namespace traygauge {

class AlignmentWindow {
 public:
  explicit AlignmentWindow(ImageView<const std::uint8_t> gray) : gray_(gray) {}

  // kAlignmentPixels values about `centre`; false when they leave the picture.
  bool sample(const Vec2& centre, float* values) {
    const double x = centre.x() - kAlignmentReach;
    const double y = centre.y() - kAlignmentReach;
    if (!(x >= 0.0 && y >= 0.0 && x < gray_.width - kStride && y < gray_.height - kRows)) return false;
    const int left = static_cast<int>(x);
    const int top = static_cast<int>(y);
    if (left != left_ || top != top_) load_pixels(left, top);
    const auto fx = static_cast<float>(x - left);
    const auto fy = static_cast<float>(y - top);
    const float upper_left = (1.0F - fx) * (1.0F - fy);
    const float upper_right = fx * (1.0F - fy);
    const float lower_left = (1.0F - fx) * fy;
    const float lower_right = fx * fy;
    for (int j = 0; j < kAlignmentSide; ++j) {
      for (int i = 0; i < kAlignmentSide; i += kFloatLanes, values += kFloatLanes) {
        const float* upper = pixels_ + j * kStride + i;
        const float* lower = upper + kStride;
        store_floats(values, (upper_left * load_floats(upper) + upper_right * load_floats(upper + 1)) +
                                 (lower_left * load_floats(lower) + lower_right * load_floats(lower + 1)));
      }
    }
    return true;
  }

 private:
  static constexpr int kRows = kAlignmentSide + 1;
  static constexpr std::ptrdiff_t kStride = kAlignmentSide + kFloatLanes;

  // Whole pixels are converted once and serve until the window leaves them.
  void load_pixels(int left, int top) {
    left_ = left;
    top_ = top;
    for (int j = 0; j < kRows; ++j) {
      const std::uint8_t* __restrict row = gray_.row(top + j) + left;
      float* __restrict target = pixels_ + j * kStride;
      for (int i = 0; i < kStride; ++i) target[i] = static_cast<float>(row[i]);
    }
  }

  ImageView<const std::uint8_t> gray_;
  int left_ = -1;
  int top_ = -1;
  alignas(16) float pixels_[kRows * kStride];
};

}  // namespace traygauge
