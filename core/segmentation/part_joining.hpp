// Which parts of food are one item: by how alike their colours are, how they meet, and the height there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/segmentation/dish_raster.hpp"
#include "core/segmentation/food_parts.hpp"

namespace traygauge {

// Logarithm of the odds that two parts are one item, by logistic regression over the borders that parts of
// rendered meals have while they are joined as they should be; a meal counts as much as another, and borders
// within an item as much as those between two. The constant is lower by 1.6 than that gives: two foods taken
// for one cost more than one food in two.
struct PartLikenessParams {
  double constant = -2.0;
  double spread = -0.021;  // for each unit by which the parts' blocks deviate from their means
  double texture = -0.52;  // for each doubling of one's bends over the other's
  double share = 4.9;      // of the smaller one's outline, that they share: mixed food is interleaved
  double valley = 2.6;     // height of the border over the lower part's crest, `most_valley` at most
  double most_valley = 1.3;
  double colours = -8.1;  // distance of how often each colour is, 0 to 1
  // What stands upon another food: the step of the surface at the border, in shares of the higher side's
  // height, where the other encloses it, by shares of its outline. Too rare in those meals to be weighed by
  // them; this does not change what they give.
  double upon = -8.0;
  double least_step = 0.35;
  double full_step = 0.6;
  double least_enclosed = 0.5;
  double full_enclosed = 0.8;
  double neck = 0.57;  // length of the border over the root of the smaller one's area
  // The side of a food that stands, whose colour is of no account: between which heights of its border over
  // its own mean it is one, how high the other part is there over its crest, and between which shares of its
  // outline.
  double least_flank = 1.24;
  double full_flank = 1.4;
  double least_edge = 0.79;
  double full_edge = 0.85;
  double least_flank_fraction = 0.25;
  double full_flank_fraction = 0.35;
  // Parts of so many blocks, one more than so many times as high as the other, are in doubt although they are
  // joined: meatballs in sauce have up to 41, two foods of the sets from 47 on.
  int doubtful_blocks = 45;
  double doubtful_crest_ratio = 2.05;
};

// All that is between two parts.
struct PartBorder {
  std::int32_t first = 0;
  std::int32_t second = 0;
  std::int32_t sides = 0;
  std::array<float, 2> heights_mm{};  // sums over its sides, on either
};

inline constexpr std::size_t kMaxPartBorders = 512;
inline constexpr std::size_t kMaxCountedParts = 256;
inline constexpr int kPartColourClasses = 12;  // of each of luma and the colour shares
using PartColours = std::array<std::uint32_t, std::size_t{3} * kPartColourClasses>;

struct PartJoiningWorkspace {
  std::span<PartBorder> borders;
  std::span<PartColours> colours;
  std::span<std::int16_t> slots;  // of a part's first block, in `colours`

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_blocks) {
    borders = arena.template take<PartBorder>(kMaxPartBorders);
    colours = arena.template take<PartColours>(kMaxCountedParts);
    slots = arena.template take<std::int16_t>(static_cast<std::size_t>(max_blocks));
  }
};

// Joins the parts that are rather one item than two, the surest first. Blocks are `side` cells of the raster
// wide. Parts beyond kMaxCountedParts stay as they are. Returns how alike the two of `least_blocks` and more
// are that resemble each other most of those which stay apart, as `params` has it, or 0 if that is more and a
// join was doubtful; −infinity where none meet.
double join_like_parts(const DishRaster& raster, int side, const PartLikenessParams& params, int least_blocks,
                       PartJoiningWorkspace& workspace, FoodParts& parts);

}  // namespace traygauge
