#include "drivers/pixels/raw_format.hpp"

#include <array>

namespace traygauge {
namespace {

constexpr auto kPatternNames = std::to_array<const char*>({"RGGB", "GRBG", "GBRG", "BGGR"});

std::size_t packed_samples(int samples, int bits) {
  const std::size_t group = bits == 10 ? 4 : 2;
  const std::size_t group_bytes = bits == 10 ? 5 : 3;
  return (static_cast<std::size_t>(samples) + group - 1) / group * group_bytes;
}

// In rows of the grey ones' stride.
int rows_with_colours(const RawFormat& format, int height) {
  switch (format.encoding) {
    case RawEncoding::nv12:
      return height + height / 2;
    case RawEncoding::yuyv:
    case RawEncoding::grey:
    case RawEncoding::mjpeg:
    case RawEncoding::rgb24:
    case RawEncoding::bgr24:
    case RawEncoding::bayer:
      break;
  }
  return height;
}

}  // namespace

std::string name(const RawFormat& format) {
  if (format.encoding != RawEncoding::bayer)
    return kRawEncodingNames[static_cast<std::size_t>(format.encoding)];
  return kPatternNames[static_cast<std::size_t>(format.pattern)] + std::to_string(format.bits) +
         (format.is_packed ? "P" : "");
}

std::size_t row_bytes(const RawFormat& format, int width) {
  const auto pixels = static_cast<std::size_t>(width);
  switch (format.encoding) {
    case RawEncoding::yuyv:
      return 2 * pixels;
    case RawEncoding::nv12:
    case RawEncoding::grey:
      return pixels;
    case RawEncoding::rgb24:
    case RawEncoding::bgr24:
      return 3 * pixels;
    case RawEncoding::bayer:
      return format.is_packed ? packed_samples(width, format.bits) : (format.bits > 8 ? 2 : 1) * pixels;
    case RawEncoding::mjpeg:
      break;
  }
  return 0;
}

std::size_t frame_bytes(const RawFormat& format, int width, int height, std::ptrdiff_t stride_bytes) {
  const std::size_t row = row_bytes(format, width);
  if (row == 0) return 0;
  const auto rows = static_cast<std::size_t>(rows_with_colours(format, height));
  return static_cast<std::size_t>(stride_bytes) * (rows - 1) + row;
}

PixelFormat converted_pixels(const RawFormat& format) {
  switch (format.encoding) {
    case RawEncoding::grey:
      return PixelFormat::gray8;
    case RawEncoding::mjpeg:
    case RawEncoding::rgb24:
      return PixelFormat::rgb8;
    case RawEncoding::yuyv:
    case RawEncoding::nv12:
    case RawEncoding::bgr24:
    case RawEncoding::bayer:
      break;
  }
  return PixelFormat::bgr8;
}

bool is_size_supported(const RawFormat& format, int width, int height) {
  if (width <= 0 || height <= 0) return false;
  switch (format.encoding) {
    case RawEncoding::yuyv:
      return width % 2 == 0;
    case RawEncoding::nv12:
      return width % 2 == 0 && height % 2 == 0;
    case RawEncoding::bayer:
      return width % 2 == 0 && height % 2 == 0 && width >= 4 && height >= 4 &&
             (!format.is_packed || width % 4 == 0);
    case RawEncoding::grey:
    case RawEncoding::mjpeg:
    case RawEncoding::rgb24:
    case RawEncoding::bgr24:
      break;
  }
  return true;
}

}  // namespace traygauge
