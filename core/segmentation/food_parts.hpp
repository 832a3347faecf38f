// Blocks of food that are merged into parts.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/segmentation/picture_reading.hpp"

namespace traygauge {

// A block of food or, where it is the first of a part, the sums over all of the part.
struct FoodBlock {
  std::int32_t parent = -1;  // −1: no food
  std::int32_t size = 0;     // blocks
  float luma = 0.0F;         // sums over the blocks
  float red = 0.0F;
  float green = 0.0F;
  Embedding embedding{};
  std::int32_t sides = 0;  // of a part's outline, in sides of blocks
};

// What makes up a difference of 1 between parts, by each sign alone.
struct PartDifferenceParams {
  double luma_weight = 0.5;  // of a colour, beside the colour shares
  double colour = 8.0;
  // Midway between what the network's training pulls one food to (0.3) and pushes two foods to (3.0).
  double embedding = 1.65;
};

class FoodParts {
 public:
  FoodParts(std::span<FoodBlock> blocks, int columns, int rows, const PartDifferenceParams& params)
      : blocks_(blocks),
        columns_(columns),
        rows_(rows),
        luma_scale_(static_cast<float>(params.luma_weight / params.colour)),
        colour_scale_(static_cast<float>(1.0 / params.colour)),
        embedding_scale_(static_cast<float>(1.0 / params.embedding)) {}

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
    for (std::size_t i = 0; i < a.embedding.size(); ++i) a.embedding[i] += b.embedding[i];
    b.parent = kept;
  }

  // Squared difference of two parts' means, by colour and embedding together.
  float square_between(const FoodBlock& a, const FoodBlock& b) const {
    const float luma = luma_scale_ * mean_step(a, b, a.luma, b.luma);
    const float red = colour_scale_ * mean_step(a, b, a.red, b.red);
    const float green = colour_scale_ * mean_step(a, b, a.green, b.green);
    const float embedding = embedding_scale_ * embedding_between(a, b);
    return luma * luma + red * red + green * green + embedding * embedding;
  }

  // Distance of the mean embeddings of two parts.
  static float embedding_between(const FoodBlock& a, const FoodBlock& b) {
    float sum = 0.0F;
    for (std::size_t i = 0; i < a.embedding.size(); ++i) {
      const float step = mean_step(a, b, a.embedding[i], b.embedding[i]);
      sum += step * step;
    }
    return std::sqrt(sum);
  }

 private:
  static float mean_step(const FoodBlock& a, const FoodBlock& b, float a_sum, float b_sum) {
    return a_sum / static_cast<float>(a.size) - b_sum / static_cast<float>(b.size);
  }

  std::span<FoodBlock> blocks_;
  int columns_;
  int rows_;
  float luma_scale_;
  float colour_scale_;
  float embedding_scale_;
};

}  // namespace traygauge
