#include <png.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

constexpr png_alloc_size_t kMaxChunkBytes = png_alloc_size_t{4} << 20U;  // texts and profiles

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
    png_set_chunk_malloc_max(png_, kMaxChunkBytes);
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

constexpr const char* kWhole = "a whole, undamaged PNG picture";
constexpr const char* kAgain = "copy or take the picture again";

std::string describe_layout(const PngDecoder& decoder) {
  const char* kind = "grey";
  if (decoder.color_type() == PNG_COLOR_TYPE_PALETTE) kind = "palette";
  if (decoder.color_type() == PNG_COLOR_TYPE_RGB) kind = "RGB";
  if (decoder.color_type() == PNG_COLOR_TYPE_RGB_ALPHA) kind = "RGB with transparency";
  if (decoder.color_type() == PNG_COLOR_TYPE_GRAY_ALPHA) kind = "grey with transparency";
  return std::to_string(decoder.bit_depth()) + "-bit " + kind;
}

void read_header(PngDecoder& decoder, const InputFile& file, std::optional<PictureSize> required) {
  if (!decoder.read_header()) throw InputError(file, kWhole, decoder.message(), kAgain);
  check_picture_size(file, decoder.width(), decoder.height(), required);
}

// A grey PNG of exactly `bits`, as stored.
void read_gray(const InputFile& file, PictureSize required, int bits, const char* hint,
               std::vector<std::uint8_t>& samples) {
  const std::string expected = std::to_string(bits) + "-bit grey PNG";
  const std::vector<std::uint8_t> bytes = read_bytes(file, kMaxPictureFileBytes, expected.c_str());
  if (bytes.size() < 8 || png_sig_cmp(bytes.data(), 0, 8) != 0) {
    throw InputError(file, expected, bytes.empty() ? "an empty file" : "bytes of another kind", hint);
  }
  PngDecoder decoder(bytes);
  read_header(decoder, file, required);
  if (decoder.color_type() != PNG_COLOR_TYPE_GRAY || decoder.bit_depth() != bits) {
    throw InputError(file, expected, describe_layout(decoder), hint);
  }
  const std::size_t stride = static_cast<std::size_t>(required.width) * static_cast<std::size_t>(bits / 8);
  samples.resize(stride * static_cast<std::size_t>(required.height));
  if (!decoder.read_rows(samples.data(), stride)) throw InputError(file, kWhole, decoder.message(), kAgain);
}

}  // namespace

Picture decode_png(const InputFile& file, std::span<const std::uint8_t> bytes,
                   std::optional<PictureSize> required) {
  PngDecoder decoder(bytes);
  read_header(decoder, file, required);
  if (decoder.bit_depth() > 8) {
    throw InputError(file, "8 bits a channel", describe_layout(decoder), "convert it to 8-bit grey or RGB");
  }
  if (!decoder.expand_to_picture()) throw InputError(file, kWhole, decoder.message(), kAgain);
  const bool gray = (decoder.color_type() & PNG_COLOR_MASK_COLOR) == 0;
  Picture picture({static_cast<int>(decoder.width()), static_cast<int>(decoder.height())},
                  gray ? PixelFormat::gray8 : PixelFormat::rgb8);
  if (!decoder.read_rows(picture.pixels.data(), static_cast<std::size_t>(picture.stride_bytes()))) {
    throw InputError(file, kWhole, decoder.message(), kAgain);
  }
  return picture;
}

Picture read_label_picture(const InputFile& file, PictureSize required) {
  Picture labels;
  labels.size = required;
  read_gray(file, required, 8,
            "store the labels as 8-bit grey PNG: 0 background, 1 dish, 2 to 199 food, 255 card",
            labels.pixels);
  return labels;
}

DepthPicture read_depth_picture(const InputFile& file, PictureSize required) {
  std::vector<std::uint8_t> samples;
  read_gray(file, required, 16, "store depth as 16-bit grey PNG", samples);
  DepthPicture depth{required, std::vector<std::uint16_t>(samples.size() / 2)};
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {  // PNG stores the high byte first
    depth.pixels[i] = static_cast<std::uint16_t>(samples[2 * i] << 8U | samples[2 * i + 1]);
  }
  return depth;
}

}  // namespace traygauge
