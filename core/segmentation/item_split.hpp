// Splits food into items: blocks of some millimetres are merged with the neighbour that resembles them most,
// by colour and by the network's embedding, into parts that are surely of one food; of these the like ones
// are joined.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "core/base/arena.hpp"
#include "core/image_view/image_view.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/food_parts.hpp"
#include "core/segmentation/part_joining.hpp"

namespace traygauge {

struct ItemSplitParams {
  double block_mm = 7.0;
  int max_blocks = 4096;
  PartDifferenceParams difference;
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
  std::span<std::uint8_t> labels;  // of each part, at its first block
  std::span<std::int32_t> core_blocks;
  std::span<FoodBorder> borders;
  PartJoiningWorkspace joining;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const ItemSplitParams& params) {
    const auto count = static_cast<std::size_t>(params.max_blocks);
    blocks = arena.template take<FoodBlock>(count);
    labels = arena.template take<std::uint8_t>(count);
    core_blocks = arena.template take<std::int32_t>(count);
    borders = arena.template take<FoodBorder>(2 * count);  // to the right and below
    joining.allocate(arena);
  }
};

struct PartedFood {
  FoodParts parts;
  int side = 1;  // of a block, in cells of the raster
};

// The cells that are `food`, in parts that are surely of one food each.
PartedFood part_food(const DishRaster& raster, const PictureReading& reading, std::uint8_t food,
                     const ItemSplitParams& params, ItemSplitWorkspace& workspace,
                     ImageView<const std::uint8_t> owners);

struct ItemSplit {
  int items = 0;
  // Of the two that resemble each other most of those that meet: PartLikenessParams' odds that they are one.
  double most_alike = -std::numeric_limits<double>::infinity();
};

// `owners`: every cell that is `food` in a block wholly of food gets a label from `first` on, by item, if all
// about it are of the same; the other cells stay. There are at most `max_items` labels.
ItemSplit split_items(const DishRaster& raster, const PictureReading& reading, std::uint8_t food,
                      const ItemSplitParams& params, ItemSplitWorkspace& workspace, std::uint8_t first,
                      int max_items, ImageView<std::uint8_t> owners);

}  // namespace traygauge
