// A tray's photograph for people: small, as JPEG.
#pragma once

#include <string>

#include "core/image_view/image_view.hpp"

namespace traygauge {

// At most 800 pixels wide and high, some 60 kB. Empty where there is no frame, or no memory.
std::string compose_picture(const FrameView& frame);

}  // namespace traygauge
