// What the pixels of every food item are good for: which carry texture that can be matched, and which are
// clipped.
#pragma once

#include <array>
#include <cstdint>

#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

struct ItemPixelParams {
  std::uint8_t crushed_level = 2;  // grey value up to which a pixel holds no information; sensor black
  // Standard deviation of means over 4 × 4 px, a linear shade apart: below, compression and quantisation
  // alone make as much. Yoghurt has 1.1 to 1.8, a banana's skin 0.9 to 2, other food 4 to 15.
  double min_texture = 1.0;
  double min_texture_over_noise = 2.0;  // the same over what white noise of the block's level gives
};

struct ItemPixels {
  std::uint32_t pixels = 0;
  std::uint32_t clipped = 0;   // of those, at either end of the grey values
  std::uint32_t blocks = 0;    // of 16 × 16 px wholly on the item
  std::uint32_t textured = 0;  // of those

  double clipped_fraction() const { return pixels == 0 ? 0.0 : static_cast<double>(clipped) / pixels; }
  double textured_fraction() const { return blocks == 0 ? 1.0 : static_cast<double>(textured) / blocks; }
};

using ItemPixelTable = std::array<ItemPixels, kLastItemLabel + 1>;  // by label

// Over the dish's box.
void measure_item_pixels(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                         const PixelBox& dish, const ItemPixelParams& params, ItemPixelTable& items);

// Blocks by their label in the first view that are wholly on items, and without texture, in both views at the
// same place of the picture.
using BlankBlockTable = std::array<std::uint32_t, kLastItemLabel + 1>;

// Over the dish's box in the first view; both pictures are of one size.
void count_blank_blocks(const std::array<ImageView<const std::uint8_t>, 2>& grays,
                        const std::array<ImageView<const std::uint8_t>, 2>& labels, const PixelBox& dish,
                        const ItemPixelParams& params, BlankBlockTable& blank);

}  // namespace traygauge
