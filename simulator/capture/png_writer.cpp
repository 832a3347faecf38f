#include "simulator/capture/png_writer.hpp"

#include <png.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
#include <system_error>

#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

// libpng reports by leaving through longjmp: no object with a destructor may be born after setjmp.
bool encode(std::FILE* stream, const FrameView& picture) {
  png_structp png = png_create_write_struct(
      PNG_LIBPNG_VER_STRING, nullptr, [](png_structp self, png_const_charp) { png_longjmp(self, 1); },
      [](png_structp, png_const_charp) {});
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, stream);
  const int type = picture.format == PixelFormat::gray8 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB;
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height),
               8, type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (picture.format == PixelFormat::bgr8) png_set_bgr(png);
  for (int y = 0; y < picture.height; ++y) png_write_row(png, picture.data + y * picture.stride_bytes);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

}  // namespace

OutputError::OutputError(const std::filesystem::path& file, const std::string& reason)
    : std::runtime_error(printable(file.string() + ": cannot be written: " + reason +
                                   "; name a file in an existing, writable folder")) {}

void write_png(const std::filesystem::path& file, const FrameView& picture) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  if (stream == nullptr) throw OutputError(file, std::generic_category().message(errno));
  const bool encoded = encode(stream, picture);
  const int reason = errno;
  const bool closed = std::fclose(stream) == 0;
  if (encoded && closed) return;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
  throw OutputError(file, std::generic_category().message(encoded ? errno : reason));
}

}  // namespace traygauge
