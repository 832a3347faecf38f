// Blocks of food that are merged into parts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace traygauge {

// A block of equal food or, where it is the first of a part, the sums over all of the part.
struct FoodBlock {
  std::int32_t parent = -1;  // −1: no food
  std::int32_t size = 0;     // blocks
  float luma = 0.0F;         // sums over the blocks
  float red = 0.0F;
  float green = 0.0F;
  float squares = 0.0F;    // of all three, luma weighted
  float texture = 0.0F;    // logarithms to base 2 of its bends
  float height_mm = 0.0F;  // over the dish
  float height_squares = 0.0F;
  float own_height_mm = 0.0F;  // of this block alone
  std::int32_t sides = 0;      // of a part's outline, in sides of blocks
};

class FoodParts {
 public:
  FoodParts(std::span<FoodBlock> blocks, int columns, int rows, double luma_weight)
      : blocks_(blocks), columns_(columns), rows_(rows), luma_weight_(static_cast<float>(luma_weight)) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::span<FoodBlock> blocks() const { return blocks_; }
  FoodBlock& at(int block) const { return blocks_[static_cast<std::size_t>(block)]; }
  bool is_food(int block) const { return at(block).parent >= 0; }
  int root(int block) const {
    while (at(block).parent != block) block = at(block).parent;
    return block;
  }

  template <class Take>
  void for_each_block(Take&& take) const {
    for (int block = 0; block < columns_ * rows_; ++block) take(block);
  }
  // Every pair of blocks side by side or one above the other.
  template <class Take>
  void for_each_side(Take&& take) const {
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        const int block = y * columns_ + x;
        if (x + 1 < columns_) take(block, block + 1);
        if (y + 1 < rows_) take(block, block + columns_);
      }
    }
  }

  void join(int kept, int joined) const {
    FoodBlock& a = at(kept);
    FoodBlock& b = at(joined);
    a.size += b.size;
    a.luma += b.luma;
    a.red += b.red;
    a.green += b.green;
    a.squares += b.squares;
    a.texture += b.texture;
    a.height_mm += b.height_mm;
    a.height_squares += b.height_squares;
    b.parent = kept;
  }

  // Of the colours of its blocks about their mean, squared.
  float spread_of(const FoodBlock& part) const {
    const auto n = static_cast<float>(part.size);
    const float luma = luma_weight_ * part.luma;
    const float mean = (luma * luma + part.red * part.red + part.green * part.green) / (n * n);
    return std::max(0.0F, part.squares / n - mean);
  }

  float square_between(const FoodBlock& a, const FoodBlock& b) const {
    const auto na = static_cast<float>(a.size);
    const auto nb = static_cast<float>(b.size);
    const float luma = luma_weight_ * (a.luma / na - b.luma / nb);
    const float red = a.red / na - b.red / nb;
    const float green = a.green / na - b.green / nb;
    return luma * luma + red * red + green * green;
  }

  static float mean_mm(const FoodBlock& part) { return part.height_mm / static_cast<float>(part.size); }
  // About as high as a part's upper half.
  static float crest_mm(const FoodBlock& part) {
    const float mean = mean_mm(part);
    const float square = part.height_squares / static_cast<float>(part.size);
    return mean + std::sqrt(std::max(0.0F, square - mean * mean));
  }
  // Of the higher one's crest to the lower one's.
  static float crest_ratio(const FoodBlock& a, const FoodBlock& b) {
    const float a_mm = crest_mm(a);
    const float b_mm = crest_mm(b);
    return std::max(a_mm, b_mm) / std::max(1.0F, std::min(a_mm, b_mm));
  }

 private:
  std::span<FoodBlock> blocks_;
  int columns_;
  int rows_;
  float luma_weight_;
};

}  // namespace traygauge
