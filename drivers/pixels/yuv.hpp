// Grey and shared colours to blue, green, red.
#pragma once

#include <cstdint>

#include "drivers/pixels/raw_format.hpp"

namespace traygauge {

// `bgr` has room for width × height × 3 bytes, rows without padding. The frame is whole: frame_bytes().
// Widths are even, for NV12 heights too. To the nearest integer at 20 fractional bits of the coefficients.
void convert_yuyv(const RawFrame& frame, const YuvCoding& coding, std::uint8_t* bgr);
void convert_nv12(const RawFrame& frame, const YuvCoding& coding, std::uint8_t* bgr);

}  // namespace traygauge
