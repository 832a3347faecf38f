#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs FILE
// jpeglib.h relies on the two above.
#include <jpeglib.h>

#include <array>
#include <string>

#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

constexpr int kMaxScans = 100;  // a progressive picture has about 10; more is an attack on our time

// libjpeg reports by leaving through longjmp, so between setjmp and a call into the library no object with a
// destructor may be born.
class JpegDecoder {
 public:
  explicit JpegDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    decoder_.err = jpeg_std_error(&errors_);
    decoder_.client_data = this;
    errors_.error_exit = [](j_common_ptr common) { of(common)->leave(); };
    errors_.emit_message = [](j_common_ptr common, int level) {
      // The library calls a picture that ends early or has damaged data a warning, and invents the rest.
      if (level < 0) of(common)->leave();
    };
    errors_.output_message = [](j_common_ptr) {};
    progress_.progress_monitor = [](j_common_ptr common) { of(common)->watch_scans(); };
  }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
  ~JpegDecoder() { jpeg_destroy_decompress(&decoder_); }

  bool read_header() {
    if (setjmp(escape_) != 0) return false;
    jpeg_create_decompress(&decoder_);
    decoder_.progress = &progress_;
    jpeg_mem_src(&decoder_, bytes_.data(), bytes_.size());
    jpeg_read_header(&decoder_, TRUE);
    return true;
  }

  // `pixels` has room for width × height × channels().
  bool read_pixels(std::uint8_t* pixels) {
    if (setjmp(escape_) != 0) return false;
    decoder_.out_color_space = channels() == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_start_decompress(&decoder_);
    const std::size_t stride =
        static_cast<std::size_t>(decoder_.output_width) * static_cast<std::size_t>(channels());
    while (decoder_.output_scanline < decoder_.output_height) {
      JSAMPROW row = pixels + decoder_.output_scanline * stride;
      jpeg_read_scanlines(&decoder_, &row, 1);
    }
    jpeg_finish_decompress(&decoder_);
    return true;
  }

  unsigned width() const { return decoder_.image_width; }
  unsigned height() const { return decoder_.image_height; }
  int channels() const { return decoder_.num_components; }
  std::string message() const { return message_.data(); }

 private:
  static JpegDecoder* of(j_common_ptr common) { return static_cast<JpegDecoder*>(common->client_data); }

  [[noreturn]] void leave() {
    if (message_[0] == '\0')
      errors_.format_message(reinterpret_cast<j_common_ptr>(&decoder_), message_.data());
    std::longjmp(escape_, 1);
  }

  void watch_scans() {
    if (decoder_.input_scan_number <= kMaxScans) return;
    std::snprintf(message_.data(), message_.size(), "more than %d scans", kMaxScans);
    leave();
  }

  std::span<const std::uint8_t> bytes_;
  jpeg_decompress_struct decoder_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  std::jmp_buf escape_{};
  std::array<char, JMSG_LENGTH_MAX> message_{};
};

}  // namespace

Picture decode_jpeg(const InputFile& file, std::span<const std::uint8_t> bytes,
                    std::optional<PictureSize> required) {
  constexpr const char* expected = "a whole, undamaged JPEG picture";
  constexpr const char* hint = "copy or take the picture again";
  JpegDecoder decoder(bytes);
  if (!decoder.read_header()) throw InputError(file, expected, decoder.message(), hint);
  check_picture_size(file, decoder.width(), decoder.height(), required);
  if (decoder.channels() != 1 && decoder.channels() != 3) {
    throw InputError(file, "a grey or RGB picture", std::to_string(decoder.channels()) + " channels",
                     "convert it to RGB");
  }
  const PixelFormat format = decoder.channels() == 1 ? PixelFormat::gray8 : PixelFormat::rgb8;
  Picture picture({static_cast<int>(decoder.width()), static_cast<int>(decoder.height())}, format);
  if (!decoder.read_pixels(picture.pixels.data())) throw InputError(file, expected, decoder.message(), hint);
  return picture;
}

}  // namespace traygauge
