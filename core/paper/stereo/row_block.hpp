// Eight rows of a rectified pair with their surroundings, column by column.
#pragma once

#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/paper/stereo/block_rows.hpp"

namespace traygauge::paper {

// One picture of the pair over the block's rows.
struct BlockPicture {
  std::span<PixelColumn> pixels;  // rows beyond the picture repeat its border
  std::span<ByteLanes> inside;    // 0xff within the mask and the picture
  int width = 0;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_columns) {
    pixels = arena.template take<PixelColumn>(static_cast<std::size_t>(max_columns));
    inside = arena.template take<ByteLanes>(static_cast<std::size_t>(max_columns));
  }
};

// Takes the rows top … top + kRowLanes − 1 and what their windows and census reach.
void load_block(ImageView<const std::uint8_t> picture, ImageView<const std::uint8_t> mask, int top,
                BlockPicture& block);

// The columns in which a row of the block itself lies within the mask; empty when none does.
Interval masked_columns(const BlockPicture& block);

}  // namespace traygauge::paper
