#include "core/segmentation/item_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/labels/label_regions.hpp"
#include "core/segmentation/colour_sum.hpp"

namespace traygauge {
namespace {

class Merging {
 public:
  Merging(const FoodParts& parts, std::span<FoodBorder> storage, const ItemSplitParams& params)
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
    if (std::min(a.size, b.size) >= params_.min_item_blocks && square > 1.0F)
      return std::numeric_limits<float>::infinity();
    const auto na = static_cast<float>(a.size);
    const auto nb = static_cast<float>(b.size);
    return square * na * nb / (na + nb);
  }

  const FoodParts& parts_;
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
                int side, ItemSplitWorkspace& workspace, ImageView<std::uint8_t> owners) {
  const auto core_blocks = [&](int part) -> std::int32_t& {
    return workspace.core_blocks[static_cast<std::size_t>(part)];
  };
  const auto label_of = [&](int part) -> std::uint8_t& {
    return workspace.labels[static_cast<std::size_t>(part)];
  };
  std::fill(workspace.core_blocks.begin(), workspace.core_blocks.end(), 0);
  parts.for_each_block([&](int block) {
    if (parts.is_food(block) && !meets_other_part(parts, block)) ++core_blocks(parts.root(block));
  });
  int items = 0;
  parts.for_each_block([&](int block) {
    if (!parts.is_food(block) || parts.root(block) != block) return;
    const bool is_item = parts.at(block).size >= params.min_item_blocks &&
                         core_blocks(block) >= params.min_core_blocks && items < max_items;
    label_of(block) = is_item ? static_cast<std::uint8_t>(first + items++) : kBackgroundLabel;
  });
  parts.for_each_block([&](int block) {
    if (!parts.is_food(block) || meets_other_part(parts, block)) return;
    const std::uint8_t label = label_of(parts.root(block));
    if (label == kBackgroundLabel) return;
    const int top = block / parts.columns() * side;
    const int left = block % parts.columns() * side;
    for (int y = top; y < top + side; ++y) std::fill_n(owners.row(y) + left, side, label);
  });
  return items;
}

// False unless all of the block is food.
bool sum_block(const DishRaster& raster, const PictureReading& reading, ImageView<const std::uint8_t> owners,
               std::uint8_t food, int left, int top, int side, FoodBlock& block) {
  ColourSum colours;
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      if (owners.at(x, y) != food) return false;
      colours.add(raster.colours.at(x, y));
    }
  }
  const float scale = 1.0F / static_cast<float>(side * side);
  const double middle = 0.5 * (side - 1);
  block.size = 1;
  block.luma = scale * static_cast<float>(colours.luma);
  block.red = scale * static_cast<float>(colours.red);
  block.green = scale * static_cast<float>(colours.green);
  block.embedding = reading.embedding_at(raster.pixel_of(left + middle, top + middle));
  return true;
}

}  // namespace

PartedFood part_food(const DishRaster& raster, const PictureReading& reading, std::uint8_t food,
                     const ItemSplitParams& params, ItemSplitWorkspace& workspace,
                     ImageView<const std::uint8_t> owners) {
  int side = std::max(2, static_cast<int>(std::lround(params.block_mm / raster.cell_mm)));
  while ((raster.width() / side) * (raster.height() / side) > params.max_blocks) ++side;
  const int columns = raster.width() / side;
  const int rows = raster.height() / side;
  const std::span<FoodBlock> blocks =
      workspace.blocks.first(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int block = 0; block < columns * rows; ++block) {
    FoodBlock& sums = blocks[static_cast<std::size_t>(block)];
    sums = {};
    if (sum_block(raster, reading, owners, food, block % columns * side, block / columns * side, side, sums))
      sums.parent = block;
  }
  const FoodParts parts(blocks, columns, rows, params.difference);
  Merging(parts, workspace.borders, params).run();
  return {parts, side};
}

ItemSplit split_items(const DishRaster& raster, const PictureReading& reading, std::uint8_t food,
                      const ItemSplitParams& params, ItemSplitWorkspace& workspace, std::uint8_t first,
                      int max_items, ImageView<std::uint8_t> owners) {
  const auto [parts, side] = part_food(raster, reading, food, params, workspace, owners);
  const double most_alike =
      join_like_parts(params.likeness, params.min_told_blocks, workspace.joining, parts);
  return {label_parts(parts, params, first, max_items, side, workspace, owners), most_alike};
}

}  // namespace traygauge
