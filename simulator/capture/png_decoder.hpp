// One PNG picture in memory, by libpng, for readers of pictures and of labels.
#pragma once

#include <png.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "simulator/capture/picture_file.hpp"

namespace traygauge {

inline constexpr png_alloc_size_t kMaxPngChunkBytes = png_alloc_size_t{4} << 20U;  // texts and profiles

// libpng reports by leaving through longjmp, so between setjmp and a call into the library no object with a
// destructor may be born.
class PngDecoder {
 public:
  explicit PngDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, [](png_structp, png_const_charp) {});
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
  }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool read_header() {
    if (info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_user_limits(png_, kMaxPictureSide, kMaxPictureSide);
    png_set_chunk_malloc_max(png_, kMaxPngChunkBytes);
    png_set_read_fn(png_, this, on_read);
    png_read_info(png_, info_);
    return true;
  }

  // 8 bits a channel, grey or RGB; palettes become colours, transparency is dropped.
  bool expand_to_picture() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    if (color_type() == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png_);
    if (color_type() == PNG_COLOR_TYPE_GRAY && bit_depth() < 8) png_set_expand_gray_1_2_4_to_8(png_);
    png_set_strip_alpha(png_);
    return true;
  }

  // Samples as stored, a byte or two each; palettes stay indices, and values below 8 bits are not stretched.
  bool keep_values() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_packing(png_);
    return true;
  }

  bool read_rows(std::uint8_t* pixels, std::size_t stride_bytes) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != stride_bytes) png_error(png_, "rows of an unexpected length");
    for (int pass = 0; pass < passes; ++pass) {
      for (png_uint_32 y = 0; y < height(); ++y) png_read_row(png_, pixels + y * stride_bytes, nullptr);
    }
    png_read_end(png_, nullptr);
    return true;
  }

  png_uint_32 width() const { return png_get_image_width(png_, info_); }
  png_uint_32 height() const { return png_get_image_height(png_, info_); }
  int bit_depth() const { return png_get_bit_depth(png_, info_); }
  int channels() const { return png_get_channels(png_, info_); }
  int color_type() const { return png_get_color_type(png_, info_); }
  std::string message() const { return message_[0] == '\0' ? "too little memory" : message_.data(); }

 private:
  [[noreturn]] static void on_error(png_structp png, png_const_charp text) {
    auto* self = static_cast<PngDecoder*>(png_get_error_ptr(png));
    std::strncpy(self->message_.data(), text, self->message_.size() - 1);
    png_longjmp(png, 1);
  }

  static void on_read(png_structp png, png_bytep target, png_size_t count) {
    auto* self = static_cast<PngDecoder*>(png_get_io_ptr(png));
    if (count > self->bytes_.size() - self->position_) png_error(png, "the file ends too early");
    std::memcpy(target, self->bytes_.data() + self->position_, count);
    self->position_ += count;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::array<char, 160> message_{};
};

// "8-bit RGB", for people.
std::string describe_layout(const PngDecoder& decoder);

// Begins with the size that is required, if one; throws InputError.
void read_header(PngDecoder& decoder, const InputFile& file, std::optional<PictureSize> required);
// Says why the decoder could not read on.
[[noreturn]] void refuse_damaged_png(const PngDecoder& decoder, const InputFile& file);

}  // namespace traygauge
