// A camera's raw pictures, checked and converted.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/pixels/jpeg_decoder.hpp"
#include "drivers/pixels/raw_format.hpp"

namespace traygauge {

// For one format and size. Takes its memory at construction; converting allocates nothing, but for MJPEG,
// see JpegDecoder.
class FrameConverter {
 public:
  // is_size_supported() holds. `stride_bytes`: of the camera's rows; not used for MJPEG.
  FrameConverter(const RawFormat& format, int width, int height, std::ptrdiff_t stride_bytes,
                 const YuvCoding& coding = {});

  const RawFormat& format() const { return format_; }
  int width() const { return width_; }
  int height() const { return height_; }
  PixelFormat pixels() const { return converted_pixels(format_); }

  // Whether these bytes can hold a picture from its first to its last byte; problem() says why not.
  bool is_whole(std::span<const std::uint8_t> bytes);
  // Of a whole one. False when it turns out damaged; `out` has room for width × height pixels.
  bool convert(std::span<const std::uint8_t> bytes, std::uint8_t* out);
  // The mean of a whole one's grey or colour values in every eighth row, 0 to 255; nothing when it turns out
  // damaged. For MJPEG at an eighth of the resolution, which costs little.
  std::optional<double> brightness(std::span<const std::uint8_t> bytes);
  // How much fine detail a whole picture has. Compares pictures of one scene; no unit. For MJPEG its length:
  // at one quality, detail is what takes bytes.
  double sharpness(std::span<const std::uint8_t> bytes);
  std::string_view problem() const { return problem_; }

 private:
  // A row's values, of which each `step`-th from the first on are of one colour.
  struct Samples {
    const std::uint8_t* first = nullptr;
    std::size_t count = 0;
    std::size_t step = 1;
  };
  Samples samples_at(std::span<const std::uint8_t> bytes, int y);
  void copy_rows(const RawFrame& frame, std::uint8_t* out) const;

  RawFormat format_;
  int width_;
  int height_;
  std::ptrdiff_t stride_bytes_;
  YuvCoding coding_;
  std::vector<std::uint8_t> scratch_;
  std::optional<JpegDecoder> jpeg_;
  std::string_view problem_;
};

// A fingerprint of the bytes: equal pictures have equal ones.
std::uint64_t fingerprint(std::span<const std::uint8_t> bytes);

}  // namespace traygauge
