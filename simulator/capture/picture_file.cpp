#include "simulator/capture/picture_file.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "simulator/capture/input_bytes.hpp"

namespace traygauge {
namespace {

constexpr const char* kPictures = "a JPEG or PNG picture";

bool starts_with(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> start) {
  if (bytes.size() < start.size()) return false;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (bytes[i] != start[i]) return false;
  }
  return true;
}

}  // namespace

bool is_jpeg(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 3> start = {0xFF, 0xD8, 0xFF};
  return starts_with(bytes, start);
}

bool is_png(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 8> start = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  return starts_with(bytes, start);
}

Picture read_picture(const InputFile& file, std::optional<PictureSize> required,
                     std::vector<InputWarning>* warnings) {
  const std::vector<std::uint8_t> bytes = read_bytes(file, kMaxPictureFileBytes, kPictures);
  if (is_jpeg(bytes)) return decode_jpeg(file, bytes, required, warnings);
  if (is_png(bytes)) return decode_png(file, bytes, required);
  throw InputError(file, kPictures, bytes.empty() ? "an empty file" : "bytes of another kind",
                   "store the picture as .jpg or .png");
}

Picture to_gray(const Picture& picture) {
  if (picture.format == PixelFormat::gray8) return picture;
  Picture gray(picture.size, PixelFormat::gray8);
  const bool blue_first = picture.format == PixelFormat::bgr8;
  for (std::size_t i = 0; i < gray.pixels.size(); ++i) {
    const std::uint8_t* pixel = &picture.pixels[3 * i];
    const unsigned red = pixel[blue_first ? 2 : 0];
    const unsigned blue = pixel[blue_first ? 0 : 2];
    // 0.299, 0.587, 0.114 in units of 2^-14.
    gray.pixels[i] = static_cast<std::uint8_t>((4899 * red + 9617 * pixel[1] + 1868 * blue + 8192) >> 14U);
  }
  return gray;
}

void check_picture_size(const InputFile& file, std::uint64_t width, std::uint64_t height,
                        std::optional<PictureSize> required) {
  const auto in_range = [](std::uint64_t side) { return side >= kMinPictureSide && side <= kMaxPictureSide; };
  const std::string found = std::to_string(width) + "x" + std::to_string(height) + " pixels";
  if (!in_range(width) || !in_range(height)) {
    throw InputError(file, "a picture of 16 to 8192 pixels a side", found, "store it at the camera's size");
  }
  if (!required) return;
  const PictureSize size{static_cast<int>(width), static_cast<int>(height)};
  if (size == *required) return;
  throw InputError(file, size_text(*required) + " pixels (the camera's size)", found,
                   "store pictures and labels at the size that the camera was calibrated for");
}

}  // namespace traygauge
