#include "drivers/pixels/jpeg_decoder.hpp"

#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs FILE
// jpeglib.h relies on the two above.
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "drivers/pixels/jpeg_warning.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kMarker = 0xFF;
constexpr std::uint8_t kStart = 0xD8;
constexpr std::uint8_t kEnd = 0xD9;
constexpr std::size_t kMaxSide = 65'536;
constexpr int kRowsAtOnce = 16;  // what the library decodes at once when colours have half the resolution

// Codes that no length follows: a 0xFF among the pixels' data, and what stands between these.
bool stands_alone(std::uint8_t code) {
  constexpr std::uint8_t first_restart = 0xD0;
  return code == 0 || code == 1 || (code >= first_restart && code <= kStart);
}

}  // namespace

JpegExtent find_jpeg(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4 || bytes[0] != kMarker || bytes[1] != kStart) return {};
  std::size_t at = 2;
  while (at + 1 < bytes.size()) {
    const void* const found = std::memchr(&bytes[at], kMarker, bytes.size() - at - 1);
    if (found == nullptr) break;
    at = static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - bytes.data());
    const std::uint8_t code = bytes[at + 1];
    if (code == kEnd) return {at + 2, true};
    if (code == kMarker) {  // padding before a marker
      ++at;
    } else if (stands_alone(code) || at + 3 >= bytes.size()) {
      at += 2;
    } else {
      at += 2 + std::size_t{bytes[at + 2]} * 256 + bytes[at + 3];  // a thumbnail in it has an end of its own
    }
  }
  // Cameras pad with zeros up to a transfer's size, some with 0xFF.
  std::size_t length = bytes.size();
  while (length > 2 && (bytes[length - 1] == 0 || bytes[length - 1] == kMarker)) --length;
  return {length, false};
}

// libjpeg reports by leaving through longjmp, so no object with a destructor is born below setjmp.
struct JpegDecoder::State {
  jpeg_decompress_struct library{};
  jpeg_error_mgr errors{};
  std::jmp_buf escape{};
  std::array<char, JMSG_LENGTH_MAX> message{};

  static State& of(j_common_ptr common) { return *static_cast<State*>(common->client_data); }

  State() {
    library.err = jpeg_std_error(&errors);
    library.client_data = this;
    errors.error_exit = [](j_common_ptr common) { of(common).leave(); };
    errors.emit_message = [](j_common_ptr common, int level) {
      // Damaged data is a warning to the library, which invents the rest.
      if (level < 0 && judge_jpeg_warning(*common->err) == JpegWarning::damage) of(common).leave();
    };
    errors.output_message = [](j_common_ptr) {};
    jpeg_create_decompress(&library);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { jpeg_destroy_decompress(&library); }

  [[noreturn]] void leave() {
    errors.format_message(reinterpret_cast<j_common_ptr>(&library), message.data());
    std::longjmp(escape, 1);
  }

  bool decode(std::span<const std::uint8_t> bytes, int width, int height, std::uint8_t* rgb) {
    if (setjmp(escape) != 0) {
      jpeg_abort_decompress(&library);
      return false;
    }
    jpeg_mem_src(&library, bytes.data(), bytes.size());
    jpeg_read_header(&library, TRUE);
    const bool has_size = library.image_width == static_cast<JDIMENSION>(width) &&
                          library.image_height == static_cast<JDIMENSION>(height);
    if (!has_size) {
      std::snprintf(message.data(), message.size(), "a picture of %u x %u", library.image_width,
                    library.image_height);
      jpeg_abort_decompress(&library);
      return false;
    }
    library.out_color_space = JCS_RGB;
    jpeg_start_decompress(&library);
    const std::size_t stride = 3 * static_cast<std::size_t>(width);
    while (library.output_scanline < library.output_height) {
      std::array<JSAMPROW, kRowsAtOnce> rows{};
      const JDIMENSION first = library.output_scanline;
      const JDIMENSION count = std::min<JDIMENSION>(kRowsAtOnce, library.output_height - first);
      for (JDIMENSION i = 0; i < count; ++i) rows[i] = rgb + (first + i) * stride;
      jpeg_read_scanlines(&library, rows.data(), count);
    }
    jpeg_finish_decompress(&library);
    return true;
  }

  // `row` has room for an eighth of the widest picture.
  bool sum_grey(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> row, double& mean) {
    if (setjmp(escape) != 0) {
      jpeg_abort_decompress(&library);
      return false;
    }
    jpeg_mem_src(&library, bytes.data(), bytes.size());
    jpeg_read_header(&library, TRUE);
    library.out_color_space = JCS_GRAYSCALE;
    library.scale_num = 1;
    library.scale_denom = 8;
    jpeg_start_decompress(&library);
    double sum = 0.0;
    const bool has_room = library.output_width <= row.size();
    while (has_room && library.output_scanline < library.output_height) {
      JSAMPROW rows[] = {row.data()};
      jpeg_read_scanlines(&library, rows, 1);
      for (JDIMENSION x = 0; x < library.output_width; ++x) sum += row[x];
    }
    mean = sum / (static_cast<double>(library.output_width) * library.output_height);
    jpeg_abort_decompress(&library);
    return has_room;
  }
};

JpegDecoder::JpegDecoder() : state_(std::make_unique<State>()) {}
JpegDecoder::~JpegDecoder() = default;

bool JpegDecoder::decode(std::span<const std::uint8_t> bytes, int width, int height, std::uint8_t* rgb) {
  return state_->decode(bytes, width, height, rgb);
}

std::optional<double> JpegDecoder::mean_grey(std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, kMaxSide / 8> row{};
  double mean = 0.0;
  return state_->sum_grey(bytes, row, mean) ? std::optional(mean) : std::nullopt;
}

std::string_view JpegDecoder::problem() const {
  return state_->message.data();
}

}  // namespace traygauge
