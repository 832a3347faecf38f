// Enlarged pictures for salient points on small structures (Bay et al. [14], 3.3: doubling the picture).
#pragma once

#include <cstdint>

#include "core/image_view/image_view.hpp"

namespace traygauge::paper {

// Bilinear, to the size of `target`; beyond the outermost pixel centres the border repeats.
void enlarge(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target);

}  // namespace traygauge::paper
