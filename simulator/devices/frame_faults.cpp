#include "simulator/devices/frame_faults.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace traygauge {
namespace {

void copy_rows(const FrameView& source, int from_row, int to_row, int columns,
               std::span<std::uint8_t> buffer) {
  const std::ptrdiff_t row_bytes = std::ptrdiff_t{columns} * bytes_per_pixel(source.format);
  for (int y = from_row; y < to_row; ++y) {
    std::memcpy(buffer.data() + y * row_bytes, source.data + y * source.stride_bytes,
                static_cast<std::size_t>(row_bytes));
  }
}

FrameView packed(const FrameView& source, int columns, int rows, std::span<std::uint8_t> buffer) {
  return {buffer.data(), columns, rows, std::ptrdiff_t{columns} * bytes_per_pixel(source.format),
          source.format};
}

}  // namespace

FrameView copy_part(const FrameView& source, int columns, int rows, std::span<std::uint8_t> buffer) {
  copy_rows(source, 0, rows, columns, buffer);
  return packed(source, columns, rows, buffer);
}

FrameView copy_frame(const FrameView& source, std::span<std::uint8_t> buffer) {
  return copy_part(source, source.width, source.height, buffer);
}

FrameView mix_frames(const FrameView& source, const FrameView& other, double share,
                     std::span<std::uint8_t> buffer) {
  const bool is_last = share > 0.0;
  const double first_fraction = is_last ? 1.0 - share : -share;
  const auto torn_at = static_cast<int>(std::lround(first_fraction * source.height));
  copy_rows(is_last ? source : other, 0, torn_at, source.width, buffer);
  copy_rows(is_last ? other : source, torn_at, source.height, source.width, buffer);
  return packed(source, source.width, source.height, buffer);
}

FrameView fill_with_noise(const FrameView& source, std::uint64_t seed, std::span<std::uint8_t> buffer) {
  const FrameView noise = packed(source, source.width, source.height, buffer);
  const auto bytes = static_cast<std::size_t>(noise.stride_bytes * noise.height);
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < bytes; i += sizeof(std::uint64_t)) {
    const std::uint64_t word = random();
    std::memcpy(buffer.data() + i, &word, std::min(sizeof(word), bytes - i));
  }
  return noise;
}

}  // namespace traygauge
