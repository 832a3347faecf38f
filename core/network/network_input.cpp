#include "core/network/network_input.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/lanes.hpp"
#include "core/network/network.hpp"

namespace traygauge {
namespace {

// Lengths along one axis in units in which a pixel of the frame is `target` long and one of the picture
// `source`: everything is an integer.
struct Axis {
  std::int64_t source = 0;
  std::int64_t target = 0;

  int first(int at) const { return static_cast<int>(at * source / target); }
  int last(int at) const { return static_cast<int>(((at + 1) * source - 1) / target); }
  // How much of the picture's pixel `at` the frame's pixel `pixel` covers.
  std::int64_t overlap(int at, int pixel) const {
    return std::min((at + 1) * source, (pixel + 1) * target) - std::max(at * source, pixel * target);
  }
};

// Places of red, green and blue in a pixel of the frame.
std::array<std::ptrdiff_t, kPictureChannels> channel_order(PixelFormat format) {
  if (format == PixelFormat::gray8) return {0, 0, 0};
  return format == PixelFormat::rgb8 ? std::array<std::ptrdiff_t, 3>{0, 1, 2}
                                     : std::array<std::ptrdiff_t, 3>{2, 1, 0};
}

class FrameReducer {
 public:
  FrameReducer(const FrameView& frame, const InputPlacement& place)
      : frame_(frame),
        columns_{frame.width, place.width},
        rows_{frame.height, place.height},
        order_(channel_order(frame.format)) {}

  void write_row(int y, std::uint8_t* out) {
    const auto width = static_cast<int>(columns_.target);
    for (int x = 0; x < width; x += kRowBlock) {
      write_block(y, x, std::min(x + kRowBlock, width), out + std::ptrdiff_t{x} * kPictureChannels);
    }
  }

 private:
  void write_block(int y, int begin, int end, std::uint8_t* out) {
    const auto count = static_cast<std::size_t>(end - begin) * kPictureChannels;
    std::fill_n(sums_.begin(), count, 0);
    for (int line = rows_.first(y); line <= rows_.last(y); ++line) {
      add_line(frame_.data + line * frame_.stride_bytes, rows_.overlap(y, line), begin, end);
    }
    const std::int64_t area = columns_.source * rows_.source;
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = static_cast<std::uint8_t>((sums_[i] + area / 2) / area);
    }
  }

  void add_line(const std::uint8_t* line, std::int64_t weight, int begin, int end) {
    const int step = bytes_per_pixel(frame_.format);
    std::int64_t* to = sums_.data();
    for (int x = begin; x < end; ++x, to += kPictureChannels) {
      std::array<std::int64_t, kPictureChannels> sums{};
      const int last = columns_.last(x);
      for (int column = columns_.first(x); column <= last; ++column) {
        const std::uint8_t* pixel = line + static_cast<std::ptrdiff_t>(column) * step;
        const std::int64_t overlap = columns_.overlap(x, column);
        for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += overlap * pixel[order_[c]];
      }
      for (std::size_t c = 0; c < sums.size(); ++c) to[c] += weight * sums[c];
    }
  }

  const FrameView& frame_;
  Axis columns_;
  Axis rows_;
  std::array<std::ptrdiff_t, kPictureChannels> order_;
  std::array<std::int64_t, std::size_t{kRowBlock} * kPictureChannels> sums_{};
};

InputPlacement place_input(int frame_width, int frame_height, int input_width, int input_height) {
  const std::int64_t by_width = std::int64_t{frame_width} * input_height;
  const std::int64_t by_height = std::int64_t{frame_height} * input_width;
  InputPlacement place{0, 0, input_width, input_height};
  if (by_width > by_height) {
    place.height = static_cast<int>(std::max<std::int64_t>(1, by_height / frame_width));
  } else {
    place.width = static_cast<int>(std::max<std::int64_t>(1, by_width / frame_height));
  }
  place.left = (input_width - place.width) / 2;
  place.top = (input_height - place.height) / 2;
  return place;
}

}  // namespace

InputPlacement fill_input(const FrameView& frame, ImageView<std::uint8_t> input) {
  const InputPlacement place =
      place_input(frame.width, frame.height, input.width / kPictureChannels, input.height);
  for (int y = 0; y < input.height; ++y) std::fill_n(input.row(y), input.width, kFillingGray);
  FrameReducer reducer(frame, place);
  for (int y = 0; y < place.height; ++y) {
    reducer.write_row(y,
                      input.row(place.top + y) + static_cast<std::ptrdiff_t>(place.left) * kPictureChannels);
  }
  return place;
}

}  // namespace traygauge
