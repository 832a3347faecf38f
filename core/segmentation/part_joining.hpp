// Which parts of food are one item: by how alike the network's embeddings of them are, and how they meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/segmentation/food_parts.hpp"

namespace traygauge {

// Logarithm of the odds that two parts that meet are one item, by logistic regression over the borders that
// parts of rendered meals have while they are joined as they should be
// (tests/evaluation/fit/fit_part_likeness.py). The constant is lower by 1 than that gives: two foods taken
// for one cost more than one food taken for two.
struct PartLikenessParams {
  double constant = 1.00;
  double embedding = -3.75;  // for each unit by which the means of their embeddings differ
  double share = 14.90;      // of the smaller one's outline, that they share: mixed food is interleaved
  // More of an outline says no more: a food that lies within another is no more one with it. No two foods of
  // those meals share more than 0.38.
  double most_share = 0.4;
};

// All that is between two parts.
struct PartBorder {
  std::int32_t first = 0;
  std::int32_t second = 0;
  std::int32_t sides = 0;
};

inline constexpr std::size_t kMaxPartBorders = 512;

struct PartJoiningWorkspace {
  std::span<PartBorder> borders;

  template <class Allocator>
  constexpr void allocate(Allocator& arena) {
    borders = arena.template take<PartBorder>(kMaxPartBorders);
  }
};

// What tells whether two parts that meet are one item; PartLikenessParams weighs it.
struct PartSigns {
  double embedding = 0.0;
  double share = 0.0;
};

// Where parts meet, once a pair; counts the sides of each part's outline as well. Borders beyond
// kMaxPartBorders are not among them.
std::span<const PartBorder> measure_borders(const FoodParts& parts, PartJoiningWorkspace& workspace);

// `border` is of measure_borders(), with no part joined since.
PartSigns signs_of(const FoodParts& parts, const PartBorder& border);

// Joins the parts that are rather one item than two, the surest first. Returns how alike the two of
// `least_blocks` and more are that resemble each other most of those which stay apart, as `params` has it;
// −infinity where none meet.
double join_like_parts(const PartLikenessParams& params, int least_blocks, PartJoiningWorkspace& workspace,
                       const FoodParts& parts);

}  // namespace traygauge
