// Splits food into items by colour: blocks of some millimetres are merged with the neighbour that resembles
// them most, until what is left differs by more than food differs from itself.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/relief_sample.hpp"

namespace traygauge {

struct ItemSplitParams {
  double block_mm = 7.0;
  int max_blocks = 4096;
  double luma_weight = 0.5;      // of a difference, beside those of the colour shares
  double max_difference = 10.0;  // of two parts of one item, where both are of one colour
  // Parts that are left are joined up to a greater difference, the more of the smaller one's outline they
  // share (mixed food is interleaved, piles only touch) and the less the surface sinks between them.
  double joined_difference = 10.0;
  double most_joined_ratio = 8.0;  // over joined_difference, where all of that speaks for one item
  double least_valley = 0.45;      // height of the border over a part's own crest, which halves it
  double full_valley = 0.75;       // … from which there is no valley
  double most_step = 0.5;          // between both sides of the border over the higher one, which halves it
  double full_step = 0.2;          // … up to which there is no step
  double touching_share = 0.25;    // of an outline, that piles share
  double mixed_share = 0.55;
  // The side of a food that stands: between which heights of its border over its own mean it is one, how high
  // the other part is there over its crest, and from which share of the outline.
  double least_flank = 1.24;
  double full_flank = 1.4;
  double least_edge = 0.79;
  double full_edge = 0.85;
  double flank_share = 0.35;
  // Deviation of a food's blocks from its mean that doubles what may be merged: mixed vegetables differ from
  // place to place.
  double mixed_deviation = 25.0;
  int min_item_blocks = 6;  // smaller is never an item of its own
  // Of an item's blocks with no other part about them: what has fewer is where two items mix.
  int min_core_blocks = 3;
};

// Blocks of equal food, summed.
struct FoodBlock {
  std::int32_t parent = -1;  // −1: no food
  std::int32_t size = 0;     // blocks
  float luma = 0.0F;         // sums over the blocks
  float red = 0.0F;
  float green = 0.0F;
  float squares = 0.0F;    // of all three, weighted
  float height_mm = 0.0F;  // over the dish
  float height_squares = 0.0F;
  float own_height_mm = 0.0F;  // of this block alone
  std::int32_t sides = 0;      // of a part's outline, in sides of blocks
};

// Where two blocks of different parts meet: the parts' first blocks, the lower one first, and what joining
// them costs.
struct FoodBorder {
  std::int32_t first = 0;
  std::int32_t second = 0;
  float cost = 0.0F;
};

// All that is between two parts.
struct PartBorder {
  std::int32_t first = 0;
  std::int32_t second = 0;
  std::int32_t sides = 0;
  std::array<float, 2> heights_mm{};  // sums over its sides, on either
};

inline constexpr std::size_t kMaxPartBorders = 512;

struct ItemSplitWorkspace {
  std::span<FoodBlock> blocks;
  std::span<FoodBorder> borders;
  std::span<PartBorder> part_borders;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const ItemSplitParams& params) {
    const auto count = static_cast<std::size_t>(params.max_blocks);
    blocks = arena.template take<FoodBlock>(count);
    borders = arena.template take<FoodBorder>(2 * count);  // to the right and below
    part_borders = arena.template take<PartBorder>(kMaxPartBorders);
  }
};

// `owners`: every cell that is `food` in a block wholly of food gets a label from `first` on, by item, if all
// about it are of the same; the other cells stay. Returns how many labels there are, at most `max_items`.
int split_items(const DishRaster& raster, ImageView<const ReliefSample> relief, std::uint8_t food,
                double cell_mm, const ItemSplitParams& params, ItemSplitWorkspace& workspace,
                std::uint8_t first, int max_items, ImageView<std::uint8_t> owners);

}  // namespace traygauge
