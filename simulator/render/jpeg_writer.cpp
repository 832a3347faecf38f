#include "simulator/render/jpeg_writer.hpp"

#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs FILE
// jpeglib.h relies on the two above.
#include <jpeglib.h>

#include <array>
#include <stdexcept>

#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

// libjpeg reports by leaving through longjmp, so between setjmp and a call into the library no object with a
// destructor may be born.
class JpegEncoder {
 public:
  JpegEncoder() {
    encoder_.err = jpeg_std_error(&errors_);
    encoder_.client_data = this;
    errors_.error_exit = [](j_common_ptr common) {
      std::longjmp(static_cast<JpegEncoder*>(common->client_data)->escape_, 1);
    };
    errors_.output_message = [](j_common_ptr) {};
  }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;
  ~JpegEncoder() { jpeg_destroy_compress(&encoder_); }

  bool encode(std::FILE* stream, const Picture& picture, int quality) {
    if (setjmp(escape_) != 0) return false;
    jpeg_create_compress(&encoder_);
    jpeg_stdio_dest(&encoder_, stream);
    encoder_.image_width = static_cast<JDIMENSION>(picture.size.width);
    encoder_.image_height = static_cast<JDIMENSION>(picture.size.height);
    encoder_.input_components = 3;
    encoder_.in_color_space = JCS_RGB;
    jpeg_set_defaults(&encoder_);  // 4:2:0
    jpeg_set_quality(&encoder_, quality, TRUE);
    jpeg_start_compress(&encoder_, TRUE);
    while (encoder_.next_scanline < encoder_.image_height) {
      // The library's interface lacks const; it reads only.
      auto* row =
          const_cast<JSAMPROW>(picture.pixels.data() +
                               static_cast<std::ptrdiff_t>(encoder_.next_scanline) * picture.stride_bytes());
      jpeg_write_scanlines(&encoder_, &row, 1);
    }
    jpeg_finish_compress(&encoder_);
    return true;
  }

 private:
  jpeg_compress_struct encoder_{};
  jpeg_error_mgr errors_{};
  std::jmp_buf escape_{};
};

}  // namespace

void write_jpeg(const std::filesystem::path& file, const Picture& picture, int quality) {
  if (picture.format != PixelFormat::rgb8) throw std::invalid_argument("write_jpeg: the picture is not RGB");
  if (quality < 1 || quality > 100) throw std::invalid_argument("write_jpeg: quality is not from 1 to 100");
  JpegEncoder encoder;
  write_stream(file, [&](std::FILE* stream) { return encoder.encode(stream, picture, quality); });
}

}  // namespace traygauge
