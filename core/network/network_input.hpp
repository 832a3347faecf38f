// A camera's frame made a network's picture.
#pragma once

#include "core/image_view/image_view.hpp"

namespace traygauge {

// Where the frame lies in a network's picture: as large as fits, in the middle; the rest is kFillingGray.
struct InputPlacement {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

inline constexpr std::uint8_t kFillingGray =
    128;  // the middle of a byte's range; training fills with the same

// `input` has three bytes a pixel: red, green, blue. See reduce_colours.
InputPlacement fill_input(const FrameView& frame, ImageView<std::uint8_t> input);

}  // namespace traygauge
