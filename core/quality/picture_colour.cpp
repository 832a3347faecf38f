#include "core/quality/picture_colour.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace traygauge {

bool shows_colour(const FrameView& frame, const PictureColourParams& params) {
  if (frame.format == PixelFormat::gray8) return false;
  std::int64_t looked_at = 0;
  std::int64_t coloured = 0;
  for (int y = 0; y < frame.height; y += params.step_px) {
    const std::uint8_t* const row = frame.data + y * frame.stride_bytes;
    for (int x = 0; x < frame.width; x += params.step_px) {
      const std::uint8_t* const pixel = row + std::ptrdiff_t{3} * x;
      const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
      ++looked_at;
      coloured += most - least > params.min_apart ? 1 : 0;
    }
  }
  return static_cast<double>(coloured) > params.min_coloured_fraction * static_cast<double>(looked_at);
}

}  // namespace traygauge
