// How long the borders between the labels of a tray are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/units.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

struct LabelBorders {
  // Pairs of adjacent pixels: a row for each label up to the last item's, a column for each label. 200 KiB.
  std::span<std::uint32_t> borders_px;

  template <class Allocator>
  constexpr void allocate(Allocator& allocator) {
    borders_px = allocator.template take<std::uint32_t>((std::size_t{kLastItemLabel} + 1) * kByteValues);
  }
  // Of an item with any other label; 0 with itself.
  std::uint32_t border_px(std::size_t item, std::size_t other) const {
    return borders_px[kByteValues * item + other];
  }
};

// Pairs of pixels side by side or one above the other, summed over `views`. O(pixels); one pass a view.
void count_borders(std::span<const ImageView<const std::uint8_t>> views, LabelBorders& borders);

}  // namespace traygauge
