#include "core/network/network_input.hpp"

#include <algorithm>

#include "core/image/resample.hpp"
#include "core/network/network.hpp"

namespace traygauge {
namespace {

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
  reduce_colours(frame, input.sub(place.left * kPictureChannels, place.top, place.width * kPictureChannels,
                                  place.height));
  return place;
}

}  // namespace traygauge
