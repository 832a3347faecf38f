// Decoded pictures that own their pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr int kMinPictureSide = 16;
inline constexpr int kMaxPictureSide = 8192;
inline constexpr std::size_t kMaxPictureFileBytes = std::size_t{128} << 20U;

struct PictureSize {
  int width = 0;
  int height = 0;
  bool operator==(const PictureSize&) const = default;
};

// "1600x1200".
inline std::string size_text(PictureSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

// 8 bits a channel, rows without padding.
struct Picture {
  PictureSize size;
  PixelFormat format = PixelFormat::gray8;
  std::vector<std::uint8_t> pixels;

  Picture() = default;
  Picture(PictureSize size_, PixelFormat format_)
      : size(size_),
        format(format_),
        pixels(area(size_) * static_cast<std::size_t>(bytes_per_pixel(format_))) {}

  std::ptrdiff_t stride_bytes() const {
    return static_cast<std::ptrdiff_t>(size.width) * bytes_per_pixel(format);
  }
  FrameView frame() const { return {pixels.data(), size.width, size.height, stride_bytes(), format}; }
  // Of a grey picture.
  ImageView<const std::uint8_t> gray() const { return {pixels.data(), size.width, size.height}; }

  static std::size_t area(PictureSize s) {
    return static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height);
  }
};

// 16-bit depth, in the units of the file.
struct DepthPicture {
  PictureSize size;
  std::vector<std::uint16_t> pixels;

  ImageView<const std::uint16_t> view() const { return {pixels.data(), size.width, size.height}; }
};

}  // namespace traygauge
