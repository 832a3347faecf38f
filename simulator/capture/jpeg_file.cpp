#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs FILE
// jpeglib.h relies on the two above.
#include <jpeglib.h>

#include <array>
#include <string>

#include "drivers/pixels/jpeg_decoder.hpp"
#include "drivers/pixels/jpeg_warning.hpp"
#include "simulator/capture/picture_file.hpp"

namespace traygauge {
namespace {

constexpr int kMaxScans = 100;  // a progressive picture has about 10; more is an attack on our time

// libjpeg reports by leaving through longjmp, so between setjmp and a call into the library no object with a
// destructor may be born.
class JpegFileDecoder {
 public:
  explicit JpegFileDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    decoder_.err = jpeg_std_error(&errors_);
    decoder_.client_data = this;
    errors_.error_exit = [](j_common_ptr common) { of(common)->leave(); };
    errors_.emit_message = [](j_common_ptr common, int level) {
      if (level < 0) of(common)->take_warning();
    };
    errors_.output_message = [](j_common_ptr) {};
    progress_.progress_monitor = [](j_common_ptr common) { of(common)->watch_scans(); };
  }
  JpegFileDecoder(const JpegFileDecoder&) = delete;
  JpegFileDecoder& operator=(const JpegFileDecoder&) = delete;
  ~JpegFileDecoder() { jpeg_destroy_decompress(&decoder_); }

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
    if (end_is_missing_ && !has_every_scan()) leave("the end is missing, and scans with it");
    jpeg_finish_decompress(&decoder_);
    return true;
  }

  unsigned width() const { return decoder_.image_width; }
  unsigned height() const { return decoder_.image_height; }
  int channels() const { return decoder_.num_components; }
  std::string message() const { return message_.data(); }
  bool end_is_missing() const { return end_is_missing_; }
  bool has_bytes_too_many() const { return has_bytes_too_many_; }

 private:
  static JpegFileDecoder* of(j_common_ptr common) {
    return static_cast<JpegFileDecoder*>(common->client_data);
  }

  [[noreturn]] void leave() {
    if (message_[0] == '\0')
      errors_.format_message(reinterpret_cast<j_common_ptr>(&decoder_), message_.data());
    std::longjmp(escape_, 1);
  }

  [[noreturn]] void leave(const char* message) {
    std::snprintf(message_.data(), message_.size(), "%s", message);
    leave();
  }

  void take_warning() {
    const JpegWarning warning = judge_jpeg_warning(errors_);
    if (warning == JpegWarning::damage) leave();
    end_is_missing_ = end_is_missing_ || warning == JpegWarning::end_missing;
    has_bytes_too_many_ = has_bytes_too_many_ || warning == JpegWarning::few_bytes_too_many;
  }

  // A picture of one scan misses none that another warning does not tell of. One of several does, unless all
  // bits of all coefficients came.
  bool has_every_scan() {
    if (jpeg_has_multiple_scans(&decoder_) == FALSE) return true;
    if (decoder_.coef_bits == nullptr) return false;
    for (int component = 0; component < decoder_.num_components; ++component) {
      for (const int missing_bits : decoder_.coef_bits[component]) {
        if (missing_bits != 0) return false;
      }
    }
    return true;
  }

  void watch_scans() {
    if (decoder_.input_scan_number > kMaxScans) leave("more than 100 scans");
  }

  std::span<const std::uint8_t> bytes_;
  jpeg_decompress_struct decoder_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  std::jmp_buf escape_{};
  std::array<char, JMSG_LENGTH_MAX> message_{};
  bool end_is_missing_ = false;
  bool has_bytes_too_many_ = false;
};

void warn(const InputFile& file, const char* code, const char* what, std::vector<InputWarning>* warnings) {
  if (warnings != nullptr) warnings->push_back({code, printable(file.path.string()) + " " + what});
}

}  // namespace

Picture decode_jpeg(const InputFile& file, std::span<const std::uint8_t> bytes,
                    std::optional<PictureSize> required, std::vector<InputWarning>* warnings) {
  constexpr const char* expected = "a whole, undamaged JPEG picture";
  constexpr const char* hint = "copy or take the picture again";
  JpegFileDecoder decoder(bytes.first(find_jpeg(bytes).length));
  if (!decoder.read_header()) throw InputError(file, expected, decoder.message(), hint);
  check_picture_size(file, decoder.width(), decoder.height(), required);
  if (decoder.channels() != 1 && decoder.channels() != 3) {
    throw InputError(file, "a grey or RGB picture", std::to_string(decoder.channels()) + " channels",
                     "convert it to RGB");
  }
  const PixelFormat format = decoder.channels() == 1 ? PixelFormat::gray8 : PixelFormat::rgb8;
  Picture picture({static_cast<int>(decoder.width()), static_cast<int>(decoder.height())}, format);
  if (!decoder.read_pixels(picture.pixels.data())) throw InputError(file, expected, decoder.message(), hint);
  if (decoder.end_is_missing()) {
    warn(file, "picture_end_missing", "ends without its end marker, though every row is there.", warnings);
  }
  if (decoder.has_bytes_too_many()) {
    warn(file, "picture_bytes_too_many",
         "holds a few bytes too many before a marker; look whether part of the picture is damaged.",
         warnings);
  }
  return picture;
}

}  // namespace traygauge
