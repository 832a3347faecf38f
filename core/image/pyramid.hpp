// Halved pictures for the hierarchical stereo (paper III-B-2, Optimization).
#pragma once

#include <cstdint>

#include "core/image_view/image_view.hpp"

namespace traygauge {

constexpr int halved(int size) {
  return (size + 1) / 2;
}

// Mean of 2 × 2 pixels, rounded; an odd last row or column is repeated. `target` measures halved(source).
void halve(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target);

// A halved mask pixel is set, to the largest of its four, when at least two of them are not 0.
void halve_mask(ImageView<const std::uint8_t> source, ImageView<std::uint8_t> target);

}  // namespace traygauge
