// The cards that `traygauge card` makes, told apart: which of them a picture is, and which lies on a table.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/geometry/camera.hpp"
#include "core/image_view/image_view.hpp"
#include "core/pipeline/tray_setup.hpp"

namespace traygauge {

// The number of the card whose picture this is, also where it was compressed or made a little lighter; none
// where it is another one's.
std::optional<int> number_of_card(ImageView<const std::uint8_t> picture);

struct CardSight {
  FrameView frame;
  LensModel lens;  // of the frame's size
};

// The number of a card of the size of `expected`, but another one, that lies in one of the pictures; none
// where none does. Draws, learns and searches each in turn, a tenth of a second a card and picture: for
// pictures in which the expected one was not found.
std::optional<int> find_other_card(std::span<const CardSight> sights, const ReferenceCard& expected);

// A sentence about the card `other`, which lies there: what was expected, and what to do. `pattern` is how
// the file of the expected card's picture is called.
std::string tell_other_card(int other, const ReferenceCard& expected, const std::string& pattern);

}  // namespace traygauge
