#include "core/image/gray_weights.hpp"
#include "core/image/resample.hpp"

#include <cstring>

namespace traygauge {

void convert_to_gray(const FrameView& frame, ImageView<std::uint8_t> gray) {
  const GrayWeights weights = gray_weights(frame.format);
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* pixel = frame.data + y * frame.stride_bytes;
    std::uint8_t* out = gray.row(y);
    if (frame.format == PixelFormat::gray8) {
      std::memcpy(out, pixel, static_cast<std::size_t>(frame.width));
      continue;
    }
    for (int x = 0; x < frame.width; ++x, pixel += 3) {
      const std::uint32_t sum =
          weights.first * pixel[0] + weights.second * pixel[1] + weights.third * pixel[2];
      out[x] = static_cast<std::uint8_t>((sum + kGrayOne / 2) / kGrayOne);
    }
  }
}

}  // namespace traygauge
