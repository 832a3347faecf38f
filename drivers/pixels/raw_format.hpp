// What cameras deliver before it is a picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/image_view/image_view.hpp"

namespace traygauge {

// Each with its name.
#define TRAYGAUGE_RAW_ENCODINGS(X) \
  X(yuyv, "YUYV")                  \
  X(nv12, "NV12")                  \
  X(grey, "GREY")                  \
  X(mjpeg, "MJPEG")                \
  X(rgb24, "RGB24")                \
  X(bgr24, "BGR24")                \
  X(bayer, "Bayer")

#define TRAYGAUGE_ENUMERATOR(encoding, text) encoding,
enum class RawEncoding : std::uint8_t { TRAYGAUGE_RAW_ENCODINGS(TRAYGAUGE_ENUMERATOR) };
#undef TRAYGAUGE_ENUMERATOR

#define TRAYGAUGE_NAME(encoding, text) text,
inline constexpr auto kRawEncodingNames =
    std::to_array<const char*>({TRAYGAUGE_RAW_ENCODINGS(TRAYGAUGE_NAME)});
#undef TRAYGAUGE_NAME
inline constexpr int kRawEncodingCount = static_cast<int>(kRawEncodingNames.size());

// The two first pixels of the two first rows.
enum class BayerPattern : std::uint8_t { rggb, grbg, gbrg, bggr };

struct RawFormat {
  RawEncoding encoding = RawEncoding::yuyv;
  BayerPattern pattern = BayerPattern::rggb;  // bayer only, as the two below
  int bits = 8;                               // a sample, 8 to 12; above 8 in two bytes, low one first
  bool is_packed = false;                     // 10 bits: four samples in five bytes; 12: two in three

  bool operator==(const RawFormat&) const = default;
};

// What the numbers of YUYV and NV12 mean.
struct YuvCoding {
  bool is_full_range = false;  // grey from 0 to 255; else 16 to 235, as in video
  bool is_bt709 = false;       // else BT.601

  bool operator==(const YuvCoding&) const = default;
};

// One picture's bytes. NV12 has its colours right behind the last row of grey, in rows of the same stride.
struct RawFrame {
  std::span<const std::uint8_t> bytes;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride_bytes = 0;
};

// As the configuration spells it: YUYV, NV12, GREY, MJPEG, RGB24, BGR24, or e.g. RGGB8, BGGR10, GRBG10P.
std::string name(const RawFormat& format);

// Bytes that a row needs at least; 0 where rows have no fixed length.
std::size_t row_bytes(const RawFormat& format, int width);
// Bytes that a whole picture needs at least; 0 where it has no fixed length.
std::size_t frame_bytes(const RawFormat& format, int width, int height, std::ptrdiff_t stride_bytes);

// What a converter makes of it.
PixelFormat converted_pixels(const RawFormat& format);

// Whether every picture of this size can be converted: even sides where colours are shared.
bool is_size_supported(const RawFormat& format, int width, int height);

}  // namespace traygauge
