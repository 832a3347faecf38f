#include "simulator/capture/picture_header.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kHeaderBytes = std::size_t{1} << 20U;  // EXIF, profiles and thumbnails stand first
constexpr std::size_t kTiffHead = 6;                         // "Exif", two zeros
constexpr unsigned kOrientationTag = 0x0112;

// Numbers of a TIFF, in its own byte order; 0 beyond its end.
struct Tiff {
  Bytes bytes;
  bool is_little_endian = false;

  unsigned number(std::size_t at, std::size_t size) const {
    unsigned value = 0;
    if (at > bytes.size() || size > bytes.size() - at) return 0;
    for (std::size_t i = 0; i < size; ++i) {
      value = (value << 8U) | bytes[at + (is_little_endian ? size - 1 - i : i)];
    }
    return value;
  }
};

unsigned big_endian(Bytes bytes, std::size_t at, std::size_t size) {
  return Tiff{bytes, false}.number(at, size);
}

bool begins_with(Bytes bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::equal(text.begin(), text.end(), bytes.begin());
}

// Of the first directory of a segment with EXIF; 1 where there is none.
int read_orientation(Bytes segment) {
  if (segment.size() < kTiffHead + 8 || !begins_with(segment, "Exif")) return 1;
  const Bytes content = segment.subspan(kTiffHead);
  const Tiff tiff{content, begins_with(content, "II")};
  const std::size_t directory = tiff.number(4, 4);
  const std::size_t count = tiff.number(directory, 2);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (tiff.number(entry, 2) != kOrientationTag) continue;
    const unsigned orientation = tiff.number(entry + 8, 2);
    return orientation >= 1 && orientation <= 8 ? static_cast<int>(orientation) : 1;
  }
  return 1;
}

bool is_frame_head(unsigned marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

std::optional<PictureHeader> read_jpeg_header(Bytes bytes) {
  PictureHeader header;
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == 0xFF) {
    const unsigned marker = bytes[at + 1];
    if (marker == 0xFF) {  // one may be repeated
      ++at;
      continue;
    }
    const std::size_t length = big_endian(bytes, at + 2, 2);
    if (length < 2 || at + 2 + length > bytes.size() || marker == 0xDA) return std::nullopt;
    const Bytes segment = bytes.subspan(at + 4, length - 2);
    if (marker == 0xE1 && header.orientation == 1) header.orientation = read_orientation(segment);
    if (is_frame_head(marker)) {
      header.size = {static_cast<int>(big_endian(segment, 3, 2)),
                     static_cast<int>(big_endian(segment, 1, 2))};
      return header;
    }
    at += 2 + length;
  }
  return std::nullopt;
}

}  // namespace

std::optional<PictureHeader> peek_header(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_first_bytes(file, kHeaderBytes);
  if (is_jpeg(bytes)) return read_jpeg_header(bytes);
  constexpr std::size_t size_end = 24;
  if (!is_png(bytes) || bytes.size() < size_end) return std::nullopt;
  PictureHeader header;
  header.size = {static_cast<int>(std::min(big_endian(bytes, 16, 4), 1U << 30U)),
                 static_cast<int>(std::min(big_endian(bytes, 20, 4), 1U << 30U))};
  return header;
}

}  // namespace traygauge
