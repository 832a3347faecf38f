#include "core/segmentation/item_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/segmentation/colour_sum.hpp"
#include "core/segmentation/glaze.hpp"

namespace traygauge {
namespace {

class Merging {
 public:
  Merging(FoodParts& parts, std::span<FoodBorder> storage, const ItemSplitParams& params)
      : parts_(parts), storage_(storage), params_(params) {}

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
      parts_.join(kept, joined);
      update_borders(kept, joined);
    }
  }

 private:
  void list_borders() {
    std::size_t count = 0;
    parts_.for_each_side([&](int block, int neighbour) {
      if (!parts_.is_food(block) || !parts_.is_food(neighbour)) return;
      storage_[count++] = {block, neighbour, cost_of(parts_.at(block), parts_.at(neighbour))};
    });
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
        border.cost = cost_of(parts_.at(border.first), parts_.at(border.second));
      borders_[count++] = border;
    }
    borders_ = borders_.first(count);
  }

  // Growth of the squared deviations (Ward 1963); infinite for two items that differ.
  float cost_of(const FoodBlock& a, const FoodBlock& b) const {
    const float square = parts_.square_between(a, b);
    const auto most = static_cast<float>(params_.max_difference);
    const int smaller = std::min(a.size, b.size);
    const bool differs = (smaller >= params_.min_item_blocks && square > most * most * slack_of(a, b)) ||
                         (smaller >= params_.min_crest_blocks &&
                          FoodParts::crest_ratio(a, b) > static_cast<float>(params_.max_crest_ratio));
    if (differs) return std::numeric_limits<float>::infinity();
    const auto na = static_cast<float>(a.size);
    const auto nb = static_cast<float>(b.size);
    return square * na * nb / (na + nb);
  }

  // Of squared differences: what both parts differ from themselves makes them differ less from each other.
  float slack_of(const FoodBlock& a, const FoodBlock& b) const {
    const auto mixed = static_cast<float>(params_.mixed_deviation);
    return 1.0F + 0.5F * (parts_.spread_of(a) + parts_.spread_of(b)) / (mixed * mixed);
  }

  FoodParts& parts_;
  std::span<FoodBorder> storage_;
  std::span<FoodBorder> borders_;
  const ItemSplitParams& params_;
};

// Eight neighbours.
bool meets_other_part(const FoodParts& parts, int block) {
  const int own = parts.root(block);
  const int column = block % parts.columns();
  const int row = block / parts.columns();
  for (int y = std::max(0, row - 1); y <= std::min(parts.rows() - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(parts.columns() - 1, column + 1); ++x) {
      const int other = y * parts.columns() + x;
      if (parts.is_food(other) && parts.root(other) != own) return true;
    }
  }
  return false;
}

// Labels the cells of the parts that are items, but for the blocks where two parts meet: these are of both.
int label_parts(const FoodParts& parts, const ItemSplitParams& params, std::uint8_t first, int max_items,
                int side, ImageView<std::uint8_t> owners) {
  // The roots' sums are no longer needed: `sides` then counts the blocks with no other part about them.
  for (FoodBlock& block : parts.blocks()) block.sides = 0;
  parts.for_each_block([&](int block) {
    if (parts.is_food(block) && !meets_other_part(parts, block)) ++parts.at(parts.root(block)).sides;
  });
  int items = 0;
  // … and `size` holds the label, 0 for what is none.
  parts.for_each_block([&](int block) {
    if (!parts.is_food(block) || parts.root(block) != block) return;
    FoodBlock& part = parts.at(block);
    const bool is_item =
        part.size >= params.min_item_blocks && part.sides >= params.min_core_blocks && items < max_items;
    part.size = is_item ? first + items++ : 0;
  });
  parts.for_each_block([&](int block) {
    if (!parts.is_food(block) || meets_other_part(parts, block)) return;
    const int label = parts.at(parts.root(block)).size;
    if (label == 0) return;
    const int top = block / parts.columns() * side;
    const int left = block % parts.columns() * side;
    for (int y = top; y < top + side; ++y)
      std::fill_n(owners.row(y) + left, side, static_cast<std::uint8_t>(label));
  });
  return items;
}

// False unless all of the block is food.
bool sum_block(const DishRaster& raster, ImageView<const HeightSample> relief,
               ImageView<const std::uint8_t> owners, std::uint8_t food, int left, int top, int side,
               double luma_weight, FoodBlock& block) {
  ColourSum colours;
  int bends = 0;
  int known = 0;
  double height_mm = 0.0;
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      if (owners.at(x, y) != food) return false;
      colours.add(raster.colours.at(x, y));
      bends += bend_at(raster.colours, x, y);
      const HeightSample& sample = relief.at(x, y);
      known += sample.is_known ? 1 : 0;
      height_mm += sample.is_known ? sample.height_mm() : 0.0;
    }
  }
  const float scale = 1.0F / static_cast<float>(side * side);
  block.size = 1;
  block.own_height_mm = block.height_mm = known > 0 ? static_cast<float>(height_mm / known) : 0.0F;
  block.height_squares = block.height_mm * block.height_mm;
  block.texture = std::log2(1.0F + scale * static_cast<float>(bends));
  block.luma = scale * static_cast<float>(colours.luma);
  block.red = scale * static_cast<float>(colours.red);
  block.green = scale * static_cast<float>(colours.green);
  const float weighted = static_cast<float>(luma_weight) * block.luma;
  block.squares = weighted * weighted + block.red * block.red + block.green * block.green;
  return true;
}

}  // namespace

ItemSplit split_items(const DishRaster& raster, ImageView<const HeightSample> relief, std::uint8_t food,
                      double cell_mm, const ItemSplitParams& params, ItemSplitWorkspace& workspace,
                      std::uint8_t first, int max_items, ImageView<std::uint8_t> owners) {
  int side = std::max(2, static_cast<int>(std::lround(params.block_mm / cell_mm)));
  while ((raster.width() / side) * (raster.height() / side) > params.max_blocks) ++side;
  const int columns = raster.width() / side;
  const int rows = raster.height() / side;
  const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  const std::span<FoodBlock> blocks = workspace.blocks.first(count);
  for (int block = 0; block < columns * rows; ++block) {
    FoodBlock& sums = blocks[static_cast<std::size_t>(block)];
    sums = {};
    if (sum_block(raster, relief, owners, food, block % columns * side, block / columns * side, side,
                  params.luma_weight, sums)) {
      sums.parent = block;
    }
  }
  FoodParts parts(blocks, columns, rows, params.luma_weight);
  Merging(parts, workspace.borders, params).run();
  const double most_alike =
      join_like_parts(raster, side, params.likeness, params.min_told_blocks, workspace.joining, parts);
  return {label_parts(parts, params, first, max_items, side, owners), most_alike};
}

}  // namespace traygauge
