// One camera's JPEG pictures, by libjpeg-turbo.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace traygauge {

// Where a picture ends: just behind its end marker, whatever follows. Where that is missing, before the
// padding at the end of `bytes`. 0: it does not begin as JPEG.
struct JpegExtent {
  std::size_t length = 0;
  bool has_end = false;
};
JpegExtent find_jpeg(std::span<const std::uint8_t> bytes);

// The library takes memory for every picture and gives it back; it cannot be told otherwise.
class JpegDecoder {
 public:
  JpegDecoder();
  ~JpegDecoder();
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  // Red, green, blue, rows without padding; `rgb` has room for width × height × 3. False when the picture is
  // damaged anywhere, or of another size: problem() says which. A few superfluous bytes before a marker are
  // no damage, nor is a missing end marker where every row is there.
  bool decode(std::span<const std::uint8_t> bytes, int width, int height, std::uint8_t* rgb);
  // Of all pixels, 0 to 255, at an eighth of the resolution; nothing when the picture is damaged.
  std::optional<double> mean_grey(std::span<const std::uint8_t> bytes);
  std::string_view problem() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace traygauge
