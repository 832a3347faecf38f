#include "firmware/handover/tray_picture.hpp"

#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs FILE
#include <cstdlib>
#include <vector>
// jpeglib.h relies on those above.
#include <jpeglib.h>

namespace traygauge {
namespace {

constexpr int kLongestSidePx = 800;
constexpr int kQuality = 80;

struct SmallPicture {
  int width = 0;
  int height = 0;
  int channels = 0;  // grey, or red, green and blue
  std::vector<std::uint8_t> pixels;
};

// Each pixel is the mean of a square of the frame's.
SmallPicture reduce(const FrameView& frame) {
  const int factor = (std::max(frame.width, frame.height) + kLongestSidePx - 1) / kLongestSidePx;
  SmallPicture small{frame.width / factor, frame.height / factor, bytes_per_pixel(frame.format), {}};
  small.pixels.reserve(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height) *
                       static_cast<std::size_t>(small.channels));
  const bool is_swapped = frame.format == PixelFormat::bgr8;
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (int c = 0; c < small.channels; ++c) {
        const int channel = is_swapped ? 2 - c : c;
        int sum = 0;
        for (int row = 0; row < factor; ++row) {
          const std::uint8_t* const begin = frame.data + (y * factor + row) * frame.stride_bytes +
                                            static_cast<std::ptrdiff_t>(x) * factor * small.channels +
                                            channel;
          for (int column = 0; column < factor; ++column)
            sum += begin[static_cast<std::ptrdiff_t>(column) * small.channels];
        }
        small.pixels.push_back(static_cast<std::uint8_t>((sum + factor * factor / 2) / (factor * factor)));
      }
    }
  }
  return small;
}

// libjpeg reports by leaving through longjmp, so between setjmp and a call into the library no object with a
// destructor may be born.
class Encoder {
 public:
  Encoder() {
    jpeg_.err = jpeg_std_error(&errors_);
    jpeg_.client_data = this;
    errors_.error_exit = [](j_common_ptr common) {
      std::longjmp(static_cast<Encoder*>(common->client_data)->escape_, 1);
    };
    errors_.output_message = [](j_common_ptr) {};
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() {
    jpeg_destroy_compress(&jpeg_);
    std::free(bytes_);
  }

  bool encode(SmallPicture& picture) {
    if (setjmp(escape_) != 0) return false;
    jpeg_create_compress(&jpeg_);
    jpeg_mem_dest(&jpeg_, &bytes_, &size_);
    jpeg_.image_width = static_cast<JDIMENSION>(picture.width);
    jpeg_.image_height = static_cast<JDIMENSION>(picture.height);
    jpeg_.input_components = picture.channels;
    jpeg_.in_color_space = picture.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&jpeg_);
    jpeg_set_quality(&jpeg_, kQuality, TRUE);
    jpeg_start_compress(&jpeg_, TRUE);
    const std::size_t row_bytes =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.channels);
    while (jpeg_.next_scanline < jpeg_.image_height) {
      JSAMPROW row = picture.pixels.data() + jpeg_.next_scanline * row_bytes;
      jpeg_write_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_compress(&jpeg_);
    return true;
  }
  std::string bytes() const { return {reinterpret_cast<const char*>(bytes_), size_}; }

 private:
  jpeg_compress_struct jpeg_{};
  jpeg_error_mgr errors_{};
  std::jmp_buf escape_{};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;  // NOLINT(google-runtime-int): libjpeg's
};

}  // namespace

std::string compose_picture(const FrameView& frame) {
  if (frame.empty()) return {};
  SmallPicture small = reduce(frame);
  Encoder encoder;
  return encoder.encode(small) ? encoder.bytes() : std::string();
}

}  // namespace traygauge
