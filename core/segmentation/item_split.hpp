// Splits food into items: blocks of some millimetres are merged with the neighbour whose colour resembles
// theirs most, until what is left differs by more than food differs from itself; of these parts the like ones
// are joined.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "core/base/arena.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/food_parts.hpp"
#include "core/segmentation/height_sample.hpp"
#include "core/segmentation/part_joining.hpp"

namespace traygauge {

struct ItemSplitParams {
  double block_mm = 7.0;
  int max_blocks = 4096;
  double luma_weight = 0.5;     // of a difference, beside those of the colour shares
  double max_difference = 8.0;  // of what is merged by colour alone, where both are of one colour
  // Deviation of a food's blocks from its mean that doubles what may be merged: mixed vegetables differ from
  // place to place.
  double mixed_deviation = 25.0;
  // Parts of so many blocks, one more than so many times as high as the other, are not merged by colour: a
  // food's own differ by up to 1.95 on the sets, and a schnitzel's and a chicken leg's by 2.2 and 3.1.
  double max_crest_ratio = 2.05;
  int min_crest_blocks = 25;
  int min_item_blocks = 6;  // smaller is never an item of its own
  // Of an item's blocks with no other part about them: what has fewer is where two items mix.
  int min_core_blocks = 3;
  int min_told_blocks = 12;  // of an item whose likeness to another one tells anything
  PartLikenessParams likeness;
};

// Where two blocks of different parts meet: the parts' first blocks, the lower one first, and what joining
// them costs.
struct FoodBorder {
  std::int32_t first = 0;
  std::int32_t second = 0;
  float cost = 0.0F;
};

struct ItemSplitWorkspace {
  std::span<FoodBlock> blocks;
  std::span<FoodBorder> borders;
  PartJoiningWorkspace joining;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const ItemSplitParams& params) {
    const auto count = static_cast<std::size_t>(params.max_blocks);
    blocks = arena.template take<FoodBlock>(count);
    borders = arena.template take<FoodBorder>(2 * count);  // to the right and below
    joining.allocate(arena, params.max_blocks);
  }
};

struct ItemSplit {
  int items = 0;
  // Of the two that resemble each other most of those that meet: PartLikenessParams' odds that they are one.
  // 0 or more if two were joined in doubt.
  double most_alike = -std::numeric_limits<double>::infinity();
};

// `owners`: every cell that is `food` in a block wholly of food gets a label from `first` on, by item, if all
// about it are of the same; the other cells stay. There are at most `max_items` labels.
ItemSplit split_items(const DishRaster& raster, ImageView<const HeightSample> relief, std::uint8_t food,
                      double cell_mm, const ItemSplitParams& params, ItemSplitWorkspace& workspace,
                      std::uint8_t first, int max_items, ImageView<std::uint8_t> owners);

}  // namespace traygauge
