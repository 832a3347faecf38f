#include "firmware/record/recorded_files.hpp"

#include <array>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include "simulator/capture/output_file.hpp"

namespace traygauge {

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw OutputError(folder, error ? error.message() : "it is no folder");
}

Picture as_rgb(const FrameView& frame) {
  const PixelFormat format = frame.format == PixelFormat::gray8 ? PixelFormat::gray8 : PixelFormat::rgb8;
  Picture picture({frame.width, frame.height}, format);
  const auto row_bytes = static_cast<std::size_t>(picture.stride_bytes());
  for (int y = 0; y < frame.height; ++y) {
    std::uint8_t* const row = picture.pixels.data() + static_cast<std::size_t>(y) * row_bytes;
    std::memcpy(row, frame.data + y * frame.stride_bytes, row_bytes);
    if (frame.format != PixelFormat::bgr8) continue;
    for (std::size_t x = 0; x < row_bytes; x += 3) std::swap(row[x], row[x + 2]);
  }
  return picture;
}

std::string four_digits(int number) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%04d", number);
  return text.data();
}

}  // namespace traygauge
