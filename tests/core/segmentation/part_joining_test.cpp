// Parts of food laid out by hand: which are joined, and what stays true however they are.
#include "core/segmentation/part_joining.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kPartColumns = 16;
constexpr int kPartRows = 12;
constexpr int kPartSide = 4;  // cells of a block
constexpr CellColour kPartGreen = {80, 90, 220};
constexpr CellColour kPartPaleGreen = {100, 90, 220};
constexpr CellColour kPartOrange = {160, 220, 120};

// Blocks of cells; `part` of a block is a number, −1 for none.
class LaidParts {
 public:
  LaidParts() {
    raster_.colours = {cells_.data(), kPartColumns * kPartSide, kPartRows * kPartSide};
    raster_.zones = {zones_.data(), kPartColumns * kPartSide, kPartRows * kPartSide};
  }

  template <class PartOf, class ColourOf, class HeightOf>
  void lay(PartOf&& part_of, ColourOf&& colour_of, HeightOf&& height_of) {
    std::vector<int> first(256, -1);
    for (int block = 0; block < kPartColumns * kPartRows; ++block) {
      const int x = block % kPartColumns;
      const int y = block / kPartColumns;
      FoodBlock& entry = blocks_[static_cast<std::size_t>(block)];
      entry = {};
      const int part = part_of(x, y);
      if (part < 0) continue;
      const CellColour colour = colour_of(x, y);
      for (int v = 0; v < kPartSide; ++v) {
        for (int u = 0; u < kPartSide; ++u) raster_.colours.at(kPartSide * x + u, kPartSide * y + v) = colour;
      }
      const auto height = static_cast<float>(height_of(x, y));
      entry.parent = block;
      entry.size = 1;
      entry.luma = colour.luma;
      entry.red = colour.red;
      entry.green = colour.green;
      entry.squares = static_cast<float>(colour.luma * colour.luma + colour.red * colour.red +
                                         colour.green * colour.green);
      entry.texture = 2.0F;
      entry.height_mm = entry.own_height_mm = height;
      entry.height_squares = height * height;
      int& root = first[static_cast<std::size_t>(part)];
      if (root < 0) root = block;
      if (root != block) parts_.join(root, block);
    }
  }
  double join(int least_blocks = 4) {
    return join_like_parts(raster_, kPartSide, {}, least_blocks, *space_, parts_);
  }
  int count() const {
    std::set<int> roots;
    parts_.for_each_block([&](int block) {
      if (parts_.is_food(block)) roots.insert(parts_.root(block));
    });
    return static_cast<int>(roots.size());
  }
  bool are_one(int ax, int ay, int bx, int by) const {
    return parts_.root(ay * kPartColumns + ax) == parts_.root(by * kPartColumns + bx);
  }
  const FoodParts& parts() const { return parts_; }

 private:
  std::vector<CellColour> cells_{std::size_t{kPartColumns} * kPartRows * kPartSide * kPartSide};
  std::vector<DishZone> zones_{cells_.size(), DishZone::inside};
  std::vector<FoodBlock> blocks_{std::size_t{kPartColumns} * kPartRows};
  DishRaster raster_;
  FoodParts parts_{blocks_, kPartColumns, kPartRows, 1.0};
  test::Allocated<PartJoiningWorkspace> space_{kPartColumns * kPartRows};
};

const auto kAllGreen = [](int, int) { return kPartGreen; };
const auto kAllAsHigh = [](int, int) { return 20.0; };

TEST(PartJoining, HalvesOfOneFoodAreOneItem) {
  LaidParts food;
  food.lay([](int x, int) { return x < 8 ? 0 : 1; }, kAllGreen, kAllAsHigh);
  ASSERT_EQ(food.count(), 2);
  EXPECT_EQ(food.join(), -std::numeric_limits<double>::infinity());  // none are left that meet
  EXPECT_EQ(food.count(), 1);
}

TEST(PartJoining, TwoColoursWithAValleyBetweenAreTwo) {
  LaidParts food;
  const auto sides = [](int x, int) { return x < 8 ? 0 : 1; };
  const auto colours = [](int x, int) { return x < 8 ? kPartGreen : kPartOrange; };
  const auto valley = [](int x, int) { return 4.0 + 3.0 * std::abs(x - 7.5); };
  food.lay(sides, colours, valley);
  EXPECT_LT(food.join(), 0.0);
  EXPECT_EQ(food.count(), 2);
  // Only parts of so many blocks tell whether the number of items is in doubt.
  food.lay(sides, colours, valley);
  EXPECT_EQ(food.join(1000), -std::numeric_limits<double>::infinity());
}

// Bits among another food, somewhat lighter: they lie all over each other.
TEST(PartJoining, BitsAllOverAnotherFoodAreMixedIn) {
  LaidParts food;
  const auto is_bit = [](int x, int y) { return x % 4 == 2 && y % 4 == 2; };
  food.lay([&](int x, int y) { return is_bit(x, y) ? 1 + x / 4 + 4 * (y / 4) : 0; },
           [&](int x, int y) { return is_bit(x, y) ? kPartPaleGreen : kPartGreen; }, kAllAsHigh);
  ASSERT_EQ(food.count(), 13);
  food.join();
  EXPECT_EQ(food.count(), 1);
}

// What lies in the middle of another food is mixed in, but not where it stands upon it.
TEST(PartJoining, WhatStandsUponAnotherFoodIsNotMixedIn) {
  const auto is_cube = [](int x, int y) { return x >= 6 && x < 10 && y >= 4 && y < 8; };
  for (const double top_mm : {6.0, 30.0}) {
    LaidParts food;
    food.lay([&](int x, int y) { return is_cube(x, y) ? 1 : 0; },
             [&](int x, int y) { return is_cube(x, y) ? kPartPaleGreen : kPartGreen; },
             [&](int x, int y) { return is_cube(x, y) ? top_mm : 6.0; });
    food.join();
    EXPECT_EQ(food.count(), top_mm > 6.0 ? 2 : 1);
  }
}

TEST(PartJoining, WhatDoesNotMeetStaysApart) {
  LaidParts food;
  food.lay([](int x, int) { return x < 7 ? 0 : x > 8 ? 1 : -1; }, kAllGreen, kAllAsHigh);
  EXPECT_EQ(food.join(), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(food.count(), 2);
  EXPECT_FALSE(food.are_one(0, 0, 15, 0));
}

TEST(PartJoining, NoFoodIsNoItem) {
  LaidParts food;
  food.lay([](int, int) { return -1; }, kAllGreen, kAllAsHigh);
  EXPECT_EQ(food.join(), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(food.count(), 0);
}

// Parts at random: joining keeps every block and every sum, and tears none.
TEST(PartJoining, KeepsAllSums) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> shade(0, 3);
  std::uniform_real_distribution<double> height(3.0, 30.0);
  const auto part_at = [](int x, int y) { return static_cast<std::size_t>(x / 4 + 4 * (y / 4)); };
  int joined = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<CellColour> colours;
    std::vector<double> heights;
    for (int i = 0; i < 12; ++i) {
      const int value = 40 * shade(random);
      colours.push_back({static_cast<std::uint8_t>(60 + value), static_cast<std::uint8_t>(90 + value),
                         static_cast<std::uint8_t>(230 - value)});
      heights.push_back(height(random));
    }
    LaidParts food;
    food.lay([&](int x, int y) { return static_cast<int>(part_at(x, y)); },
             [&](int x, int y) { return colours[part_at(x, y)]; },
             [&](int x, int y) { return heights[part_at(x, y)]; });
    EXPECT_LE(food.join(), 0.0);  // else it had gone on
    joined += 12 - food.count();
    int blocks = 0;
    float luma = 0.0F;
    food.parts().for_each_block([&](int block) {
      if (food.parts().root(block) != block) return;
      blocks += food.parts().at(block).size;
      luma += food.parts().at(block).luma;
    });
    EXPECT_EQ(blocks, kPartColumns * kPartRows);
    float all = 0.0F;
    for (const CellColour& colour : colours) all += 16.0F * static_cast<float>(colour.luma);
    EXPECT_NEAR(luma, all, 0.5F);
    for (int y = 0; y < kPartRows; ++y) {
      for (int x = 0; x < kPartColumns; ++x) EXPECT_TRUE(food.are_one(x, y, x / 4 * 4, y / 4 * 4));
    }
  }
  EXPECT_GT(joined, 40);
}

}  // namespace
}  // namespace traygauge
