// A sensor's colour mosaic to blue, green, red: missing colours are means of their nearest neighbours.
#pragma once

#include <cstdint>
#include <span>

#include "drivers/pixels/raw_format.hpp"

namespace traygauge {

// Bytes of `rows` for pictures of this width.
constexpr std::size_t bayer_scratch_bytes(int width) {
  return 3 * static_cast<std::size_t>(width);
}

// One row's samples, a byte each.
void unpack_bayer_row(const RawFormat& format, const std::uint8_t* row, int width, std::uint8_t* samples);

// Samples above 8 bits keep their upper 8. The outermost rows and columns, which miss neighbours, repeat the
// ones beside them. `scratch` has bayer_scratch_bytes(); `bgr` as for convert_yuyv.
void convert_bayer(const RawFormat& format, const RawFrame& frame, std::span<std::uint8_t> scratch,
                   std::uint8_t* bgr);

}  // namespace traygauge
