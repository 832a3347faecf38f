#include "drivers/pixels/bayer.hpp"

#include <array>
#include <cstring>

namespace traygauge {
namespace {

std::uint8_t mean(int a, int b) {
  return static_cast<std::uint8_t>((a + b + 1) >> 1);
}
std::uint8_t mean(int a, int b, int c, int d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) >> 2);
}

// A row whose own colour beside green goes to byte `own` of each pixel and the other rows' to 2 - own.
// `green_first`: whether its first pixel is green.
void convert_row(const std::array<const std::uint8_t*, 3>& rows, int width, bool green_first, int own,
                 std::uint8_t* bgr) {
  const auto& [above, here, below] = rows;
  const int other = 2 - own;
  for (int x = 1; x < width - 1; ++x) {
    std::uint8_t* const pixel = bgr + std::ptrdiff_t{3} * x;
    const bool is_green = (x % 2 == 0) == green_first;
    if (is_green) {
      pixel[own] = mean(here[x - 1], here[x + 1]);
      pixel[1] = here[x];
      pixel[other] = mean(above[x], below[x]);
    } else {
      pixel[own] = here[x];
      pixel[1] = mean(above[x], below[x], here[x - 1], here[x + 1]);
      pixel[other] = mean(above[x - 1], above[x + 1], below[x - 1], below[x + 1]);
    }
  }
  std::memcpy(bgr, bgr + 3, 3);
  std::memcpy(bgr + std::ptrdiff_t{3} * (width - 1), bgr + std::ptrdiff_t{3} * (width - 2), 3);
}

}  // namespace

void unpack_bayer_row(const RawFormat& format, const std::uint8_t* row, int width, std::uint8_t* samples) {
  const std::uint8_t* from = row;
  std::uint8_t* to = samples;
  if (format.is_packed) {  // upper bytes first, the rest of the bits behind each group
    const int group = format.bits == 10 ? 4 : 2;
    for (int x = 0; x < width; x += group, from += group + 1, to += group) {
      std::memcpy(to, from, static_cast<std::size_t>(group));
    }
  } else if (format.bits == 8) {
    std::memcpy(to, from, static_cast<std::size_t>(width));
  } else {
    const int shift = format.bits - 8;
    for (int x = 0; x < width; ++x, from += 2) {
      to[x] = static_cast<std::uint8_t>((from[0] | from[1] << 8) >> shift);
    }
  }
}

void convert_bayer(const RawFormat& format, const RawFrame& frame, std::span<std::uint8_t> scratch,
                   std::uint8_t* bgr) {
  const bool starts_green = format.pattern == BayerPattern::grbg || format.pattern == BayerPattern::gbrg;
  const bool starts_red = format.pattern == BayerPattern::rggb || format.pattern == BayerPattern::grbg;
  const std::ptrdiff_t row_bytes = std::ptrdiff_t{3} * frame.width;
  const auto row_at = [&](int y) { return scratch.data() + y % 3 * std::ptrdiff_t{frame.width}; };
  const auto unpack = [&](int y) {
    unpack_bayer_row(format, frame.bytes.data() + y * frame.stride_bytes, frame.width, row_at(y));
  };
  unpack(0);
  unpack(1);
  for (int y = 1; y < frame.height - 1; ++y) {
    unpack(y + 1);
    const bool is_even = y % 2 == 0;
    const bool green_first = is_even == starts_green;
    const int own = is_even == starts_red ? 2 : 0;
    convert_row({row_at(y - 1), row_at(y), row_at(y + 1)}, frame.width, green_first, own,
                bgr + y * row_bytes);
  }
  const auto bytes = static_cast<std::size_t>(row_bytes);
  std::memcpy(bgr, bgr + row_bytes, bytes);
  std::memcpy(bgr + (frame.height - 1) * row_bytes, bgr + (frame.height - 2) * row_bytes, bytes);
}

}  // namespace traygauge
