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
  Merging(std::span<FoodBlock> blocks, ItemSplitWorkspace& workspace, int columns, int rows,
          const ItemSplitParams& params)
      : blocks_(blocks),
        storage_(workspace.borders),
        part_borders_(workspace.part_borders),
        columns_(columns),
        rows_(rows),
        params_(params) {}

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

  // Joins parts of mixed food; the pair that differs least over what it may differ by comes first.
  void join_parts() {
    for (;;) {
      const std::span<const PartBorder> borders = measure_borders();
      float least = 1.0F;
      const PartBorder* best = nullptr;
      for (const PartBorder& border : borders) {
        const float ratio = difference_of(at(border.first), at(border.second)) / tolerance_of(border);
        if (ratio >= least) continue;
        least = ratio;
        best = &border;
      }
      if (best == nullptr) return;
      join(best->first, best->second);
    }
  }

  // Labels the cells of the parts that are items, but for the blocks where two parts meet: these are of both.
  int label_parts(std::uint8_t first, int max_items, int side, ImageView<std::uint8_t> owners) {
    // The roots' sums are no longer needed: `sides` then counts the blocks with no other part about them.
    for (FoodBlock& block : blocks_) block.sides = 0;
    for_each_block([&](int block) {
      if (is_food(block) && !meets_other_part(block)) ++at(root(block)).sides;
    });
    int items = 0;
    // … and `size` holds the label, 0 for what is none.
    for_each_block([&](int block) {
      if (!is_food(block) || root(block) != block) return;
      FoodBlock& part = at(block);
      const bool is_item =
          part.size >= params_.min_item_blocks && part.sides >= params_.min_core_blocks && items < max_items;
      part.size = is_item ? first + items++ : 0;
    });
    for_each_block([&](int block) {
      if (!is_food(block) || meets_other_part(block)) return;
      const int label = at(root(block)).size;
      if (label == 0) return;
      const int top = block / columns_ * side;
      for (int y = top; y < top + side; ++y)
        std::fill_n(owners.row(y) + block % columns_ * side, side, static_cast<std::uint8_t>(label));
    });
    return items;
  }

 private:
  template <class Take>
  void for_each_block(Take&& take) const {
    for (int block = 0; block < columns_ * rows_; ++block) take(block);
  }

  // Eight neighbours.
  bool meets_other_part(int block) const {
    const int own = root(block);
    for (int y = std::max(0, block / columns_ - 1); y <= std::min(rows_ - 1, block / columns_ + 1); ++y) {
      for (int x = std::max(0, block % columns_ - 1); x <= std::min(columns_ - 1, block % columns_ + 1);
           ++x) {
        const int other = y * columns_ + x;
        if (is_food(other) && root(other) != own) return true;
      }
    }
    return false;
  }

  std::span<const PartBorder> measure_borders() {
    for (FoodBlock& block : blocks_) block.sides = 0;
    std::size_t count = 0;
    for_each_side([&](int block, int neighbour) {
      const int own = is_food(block) ? root(block) : -1;
      const int other = is_food(neighbour) ? root(neighbour) : -1;
      if (own == other) return;
      if (own >= 0) ++at(own).sides;
      if (other >= 0) ++at(other).sides;
      if (own < 0 || other < 0) return;
      const int first = std::min(own, other);
      const int second = std::max(own, other);
      const auto known = part_borders_.first(count);
      auto border = std::find_if(known.begin(), known.end(),
                                 [&](const PartBorder& b) { return b.first == first && b.second == second; });
      if (border == known.end()) {
        if (count == part_borders_.size()) return;
        part_borders_[count++] = {first, second, 0, {}};
        border = part_borders_.begin() + static_cast<std::ptrdiff_t>(count - 1);
      }
      ++border->sides;
      border->heights_mm[0] += at(own == first ? block : neighbour).own_height_mm;
      border->heights_mm[1] += at(own == first ? neighbour : block).own_height_mm;
    });
    return part_borders_.first(count);
  }

  // About as high as a part's upper half.
  static float crest_mm(const FoodBlock& part) {
    const float mean = mean_mm(part);
    const float square = part.height_squares / static_cast<float>(part.size);
    return mean + std::sqrt(std::max(0.0F, square - mean * mean));
  }
  static float mean_mm(const FoodBlock& part) { return part.height_mm / static_cast<float>(part.size); }

  static double ramp(double value, double none, double full) {
    return std::clamp((value - none) / (full - none), 0.0, 1.0);
  }

  float tolerance_of(const PartBorder& border) const {
    const FoodBlock& a = at(border.first);
    const FoodBlock& b = at(border.second);
    const FoodBlock& smaller = a.size < b.size ? a : b;
    const double share = static_cast<double>(border.sides) / std::max(1, smaller.sides);
    const double first_mm = border.heights_mm[0] / static_cast<float>(border.sides);
    const double second_mm = border.heights_mm[1] / static_cast<float>(border.sides);
    const double lower_mm = std::max(1.0F, std::min(crest_mm(a), crest_mm(b)));
    const double valley = std::min(first_mm, second_mm) / lower_mm;
    const double step = std::abs(first_mm - second_mm) / std::max({1.0, first_mm, second_mm});
    const double level = ramp(valley, params_.least_valley, params_.full_valley) *
                         ramp(-step, -params_.most_step, -params_.full_step);
    const double mixed = ramp(share, params_.touching_share, params_.mixed_share) * level;
    const double joined = std::max(mixed, flank_of(a, b, first_mm, second_mm, share));
    return static_cast<float>(params_.joined_difference * (0.5 + 0.5 * std::max(level, joined)) *
                              (1.0 + (params_.most_joined_ratio - 1.0) * joined));
  }

  // How sure it is that the lower part is the side of the higher one, 0 to 1: it is highest where both meet,
  // and the higher one ends there without going down.
  double flank_of(const FoodBlock& a, const FoodBlock& b, double a_border_mm, double b_border_mm,
                  double share) const {
    const bool is_a_lower = mean_mm(a) < mean_mm(b);
    const double lower =
        is_a_lower ? a_border_mm / std::max(1.0F, mean_mm(a)) : b_border_mm / std::max(1.0F, mean_mm(b));
    const double higher =
        is_a_lower ? b_border_mm / std::max(1.0F, crest_mm(b)) : a_border_mm / std::max(1.0F, crest_mm(a));
    return ramp(lower, params_.least_flank, params_.full_flank) *
           ramp(higher, params_.least_edge, params_.full_edge) *
           ramp(share, params_.touching_share, params_.flank_share);
  }

  FoodBlock& at(int block) { return blocks_[static_cast<std::size_t>(block)]; }
  const FoodBlock& at(int block) const { return blocks_[static_cast<std::size_t>(block)]; }

  // Every pair of blocks side by side or one above the other.
  template <class Take>
  void for_each_side(Take&& take) {
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        const int block = y * columns_ + x;
        if (x + 1 < columns_) take(block, block + 1);
        if (y + 1 < rows_) take(block, block + columns_);
      }
    }
  }

  void list_borders() {
    std::size_t count = 0;
    for_each_side([&](int block, int neighbour) {
      if (!is_food(block) || !is_food(neighbour)) return;
      storage_[count++] = {block, neighbour, cost_of(at(block), at(neighbour))};
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

  float square_between(const FoodBlock& a, const FoodBlock& b) const {
    const auto na = static_cast<float>(a.size);
    const auto nb = static_cast<float>(b.size);
    const float luma = static_cast<float>(params_.luma_weight) * (a.luma / na - b.luma / nb);
    const float red = a.red / na - b.red / nb;
    const float green = a.green / na - b.green / nb;
    return luma * luma + red * red + green * green;
  }

  // Of squared differences: what both parts differ from themselves makes them differ less from each other.
  float slack_of(const FoodBlock& a, const FoodBlock& b) const {
    const auto mixed = static_cast<float>(params_.mixed_deviation);
    return 1.0F + 0.5F * (spread_of(a) + spread_of(b)) / (mixed * mixed);
  }

  float difference_of(const FoodBlock& a, const FoodBlock& b) const {
    return std::sqrt(square_between(a, b) / slack_of(a, b));
  }

  // Growth of the squared deviations (Ward 1963); infinite for two items that differ.
  float cost_of(const FoodBlock& a, const FoodBlock& b) const {
    const float square = square_between(a, b);
    const auto most = static_cast<float>(params_.max_difference);
    if (std::min(a.size, b.size) >= params_.min_item_blocks && square > most * most * slack_of(a, b))
      return std::numeric_limits<float>::infinity();
    const auto na = static_cast<float>(a.size);
    const auto nb = static_cast<float>(b.size);
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
    a.height_mm += b.height_mm;
    a.height_squares += b.height_squares;
    b.parent = kept;
  }

  std::span<FoodBlock> blocks_;
  std::span<FoodBorder> storage_;
  std::span<FoodBorder> borders_;
  std::span<PartBorder> part_borders_;
  int columns_;
  int rows_;
  const ItemSplitParams& params_;
};

// False unless all of the block is food.
bool sum_block(const DishRaster& raster, ImageView<const ReliefSample> relief,
               ImageView<const std::uint8_t> owners, std::uint8_t food, int left, int top, int side,
               double luma_weight, FoodBlock& block) {
  int luma = 0;
  int red = 0;
  int green = 0;
  int known = 0;
  double height_mm = 0.0;
  for (int y = top; y < top + side; ++y) {
    for (int x = left; x < left + side; ++x) {
      if (owners.at(x, y) != food) return false;
      const CellColour& colour = raster.colours.at(x, y);
      luma += colour.luma;
      red += colour.red;
      green += colour.green;
      const ReliefSample& sample = relief.at(x, y);
      known += sample.is_known ? 1 : 0;
      height_mm += sample.is_known ? sample.height_mm() : 0.0;
    }
  }
  const float scale = 1.0F / static_cast<float>(side * side);
  block.size = 1;
  block.own_height_mm = block.height_mm = known > 0 ? static_cast<float>(height_mm / known) : 0.0F;
  block.height_squares = block.height_mm * block.height_mm;
  block.luma = scale * static_cast<float>(luma);
  block.red = scale * static_cast<float>(red);
  block.green = scale * static_cast<float>(green);
  const float weighted = static_cast<float>(luma_weight) * block.luma;
  block.squares = weighted * weighted + block.red * block.red + block.green * block.green;
  return true;
}

}  // namespace

int split_items(const DishRaster& raster, ImageView<const ReliefSample> relief, std::uint8_t food,
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
  Merging merging(blocks, workspace, columns, rows, params);
  merging.run();
  merging.join_parts();
  return merging.label_parts(first, max_items, side, owners);
}

}  // namespace traygauge
