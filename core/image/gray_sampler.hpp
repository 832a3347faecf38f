// The grey value of a picture at a fraction of a pixel, for where a few are read here and there.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/image/gray_weights.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

class GraySampler {
 public:
  explicit GraySampler(ImageView<const std::uint8_t> gray)
      : GraySampler(FrameView{gray.data, gray.width, gray.height, gray.stride, PixelFormat::gray8}) {}
  explicit GraySampler(const FrameView& frame)
      : frame_(frame), weights_(gray_weights(frame.format)), bytes_(bytes_per_pixel(frame.format)) {}

  // Bilinear; false beside the frame.
  bool sample(const Vec2& pixel, float& gray) const {
    if (!(pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < frame_.width - 1 &&
          pixel.y() < frame_.height - 1))
      return false;
    const int x = static_cast<int>(pixel.x());
    const int y = static_cast<int>(pixel.y());
    const auto fx = static_cast<float>(pixel.x() - x);
    const auto fy = static_cast<float>(pixel.y() - y);
    const std::uint8_t* at = frame_.data + y * frame_.stride_bytes + static_cast<std::ptrdiff_t>(x) * bytes_;
    const std::uint8_t* below = at + frame_.stride_bytes;
    const float upper = value(at) * (1.0F - fx) + value(at + bytes_) * fx;
    const float lower = value(below) * (1.0F - fx) + value(below + bytes_) * fx;
    gray = upper * (1.0F - fy) + lower * fy;
    return true;
  }

 private:
  float value(const std::uint8_t* pixel) const {
    if (bytes_ == 1) return pixel[0];
    return static_cast<float>(weights_.first * pixel[0] + weights_.second * pixel[1] +
                              weights_.third * pixel[2]) /
           static_cast<float>(kGrayOne);
  }

  FrameView frame_;
  GrayWeights weights_;
  int bytes_;
};

}  // namespace traygauge
