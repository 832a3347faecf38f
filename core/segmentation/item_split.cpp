#include "core/segmentation/item_split.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace traygauge {
namespace {

class Merging {
 public:
  Merging(std::span<FoodBlock> blocks, std::span<FoodBorder> storage, int columns, int rows,
          const ItemSplitParams& params)
      : blocks_(blocks), storage_(storage), columns_(columns), rows_(rows), params_(params) {}

  int root(int block) const {
    while (at(block).parent != block) block = at(block).parent;
    return block;
  }
  bool is_food(int block) const { return at(block).parent >= 0; }

  // Merges until nothing admissible is left, the least cost first, of equal ones the first in the order of
  // the blocks. Each round joins two, so there are at most as many as blocks.
  void run() {
    list_borders();
    for (;;) {
      const FoodBorder* least = nullptr;
      for (const FoodBorder& border : borders_) {
        if (border.cost < (least != nullptr ? least->cost : std::numeric_limits<float>::infinity()))
          least = &border;
      }
      if (least == nullptr) return;
      const std::int32_t kept = least->first;
      const std::int32_t joined = least->second;
      join(kept, joined);
      update_borders(kept, joined);
    }
  }

 private:
  FoodBlock& at(int block) { return blocks_[static_cast<std::size_t>(block)]; }
  const FoodBlock& at(int block) const { return blocks_[static_cast<std::size_t>(block)]; }

  void list_borders() {
    std::size_t count = 0;
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        const int block = y * columns_ + x;
        if (!is_food(block)) continue;
        for (const int neighbour :
             {x + 1 < columns_ ? block + 1 : -1, y + 1 < rows_ ? block + columns_ : -1}) {
          if (neighbour < 0 || !is_food(neighbour)) continue;
          storage_[count++] = {block, neighbour, cost_of(at(block), at(neighbour))};
        }
      }
    }
    borders_ = storage_.first(count);
  }

  // After a join: those of the part that is no more are the other's, and what it cost is out of date.
  void update_borders(std::int32_t kept, std::int32_t joined) {
    std::size_t count = 0;
    for (FoodBorder border : borders_) {
      if (border.first == joined) border.first = kept;
      if (border.second == joined) border.second = kept;
      if (border.first == border.second) continue;
      if (border.first > border.second) std::swap(border.first, border.second);
      if (border.first == kept || border.second == kept)
        border.cost = cost_of(at(border.first), at(border.second));
      borders_[count++] = border;
    }
    borders_ = borders_.first(count);
  }

  float spread_of(const FoodBlock& part) const {
    const auto n = static_cast<float>(part.size);
    const auto w = static_cast<float>(params_.luma_weight);
    const float mean =
        (w * w * part.luma * part.luma + part.red * part.red + part.green * part.green) / (n * n);
    return std::max(0.0F, part.squares / n - mean);
  }

  // Growth of the squared deviations (Ward 1963); infinite for two items that differ.
  float cost_of(const FoodBlock& a, const FoodBlock& b) const {
    const auto na = static_cast<float>(a.size);
    const auto nb = static_cast<float>(b.size);
    const float luma = static_cast<float>(params_.luma_weight) * (a.luma / na - b.luma / nb);
    const float red = a.red / na - b.red / nb;
    const float green = a.green / na - b.green / nb;
    const float square = luma * luma + red * red + green * green;
    if (std::min(a.size, b.size) >= params_.min_item_blocks) {
      const auto mixed = static_cast<float>(params_.mixed_deviation);
      const auto most = static_cast<float>(params_.max_difference);
      const float variance = 0.5F * (spread_of(a) + spread_of(b));
      if (square > most * most * (1.0F + variance / (mixed * mixed)))
        return std::numeric_limits<float>::infinity();
    }
    return square * na * nb / (na + nb);
  }

  void join(int kept, int joined) {
    FoodBlock& a = at(kept);
    FoodBlock& b = at(joined);
    a.size += b.size;
    a.luma += b.luma;
    a.red += b.red;
    a.green += b.green;
    a.squares += b.squares;
    b.parent = kept;
  }

  std::span<FoodBlock> blocks_;
  std::span<FoodBorder> storage_;
  std::span<FoodBorder> borders_;
  int columns_;
  int rows_;
  const ItemSplitParams& params_;
};

// False unless all of the block is food.
bool sum_block(const DishRaster& raster, ImageView<const std::uint8_t> owners, std::uint8_t food, int left,
               int top, int side, double luma_weight, FoodBlock& block) {
  int luma = 0;
  int red = 0;
  int green = 0;
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      if (owners.at(x, y) != food) return false;
      const CellColour& colour = raster.colours.at(x, y);
      luma += colour.luma;
      red += colour.red;
      green += colour.green;
    }
  }
  const float scale = 1.0F / static_cast<float>(side * side);
  block.size = 1;
  block.luma = scale * static_cast<float>(luma);
  block.red = scale * static_cast<float>(red);
  block.green = scale * static_cast<float>(green);
  const float weighted = static_cast<float>(luma_weight) * block.luma;
  block.squares = weighted * weighted + block.red * block.red + block.green * block.green;
  return true;
}

}  // namespace

int split_items(const DishRaster& raster, std::uint8_t food, double cell_mm, const ItemSplitParams& params,
                ItemSplitWorkspace& workspace, std::uint8_t first, int max_items,
                ImageView<std::uint8_t> owners) {
  int side = std::max(2, static_cast<int>(std::lround(params.block_mm / cell_mm)));
  while ((raster.width() / side) * (raster.height() / side) > params.max_blocks) ++side;
  const int columns = raster.width() / side;
  const int rows = raster.height() / side;
  const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  const std::span<FoodBlock> blocks = workspace.blocks.first(count);
  for (int block = 0; block < columns * rows; ++block) {
    FoodBlock& sums = blocks[static_cast<std::size_t>(block)];
    sums = {};
    if (sum_block(raster, owners, food, block % columns * side, block / columns * side, side,
                  params.luma_weight, sums)) {
      sums.parent = block;
    }
  }
  Merging merging(blocks, workspace.borders, columns, rows, params);
  merging.run();
  int items = 0;
  // The roots' sums are no longer needed: `size` then holds their label.
  for (int block = 0; block < columns * rows; ++block) {
    if (!merging.is_food(block) || merging.root(block) != block) continue;
    FoodBlock& root = blocks[static_cast<std::size_t>(block)];
    const bool is_item = root.size >= params.min_item_blocks && items < max_items;
    root.size = is_item ? first + items++ : 0;
  }
  for (int block = 0; block < columns * rows; ++block) {
    if (!merging.is_food(block)) continue;
    const int label = blocks[static_cast<std::size_t>(merging.root(block))].size;
    if (label == 0) continue;
    for (int y = block / columns * side; y < (block / columns + 1) * side; ++y) {
      std::fill_n(owners.row(y) + block % columns * side, side, static_cast<std::uint8_t>(label));
    }
  }
  return items;
}

}  // namespace traygauge
