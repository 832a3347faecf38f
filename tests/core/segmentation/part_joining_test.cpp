// Parts of food laid out by hand: which are joined, and what stays true however they are.
#include "core/segmentation/part_joining.hpp"

#include <gtest/gtest.h>

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

// `part` of a block is a number, −1 for none.
class LaidParts {
 public:
  // `place_of` is where a part's embedding lies on a line.
  template <class PartOf, class PlaceOf>
  void lay(PartOf&& part_of, PlaceOf&& place_of) {
    std::vector<int> first(256, -1);
    for (int block = 0; block < kPartColumns * kPartRows; ++block) {
      FoodBlock& entry = blocks_[static_cast<std::size_t>(block)];
      entry = {};
      const int part = part_of(block % kPartColumns, block / kPartColumns);
      if (part < 0) continue;
      entry.parent = block;
      entry.size = 1;
      entry.luma = static_cast<float>(part);
      entry.embedding[0] = static_cast<float>(place_of(part));
      int& root = first[static_cast<std::size_t>(part)];
      if (root < 0) root = block;
      if (root != block) parts_.join(root, block);
    }
  }
  double join(int least_blocks = 4) { return join_like_parts({}, least_blocks, *space_, parts_); }
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
  std::vector<FoodBlock> blocks_{std::size_t{kPartColumns} * kPartRows};
  FoodParts parts_{blocks_, kPartColumns, kPartRows, {}};
  test::Allocated<PartJoiningWorkspace> space_;
};

constexpr double kNone = -std::numeric_limits<double>::infinity();
const auto kHalves = [](int x, int) { return x < 8 ? 0 : 1; };
const auto kOnePlace = [](int) { return 1.0; };

TEST(PartJoining, PartsThatReadAlikeAreOneItem) {
  LaidParts food;
  food.lay(kHalves, kOnePlace);
  ASSERT_EQ(food.count(), 2);
  EXPECT_EQ(food.join(), kNone);  // none are left that meet
  EXPECT_EQ(food.count(), 1);
}

TEST(PartJoining, PartsThatReadDifferentlyAreTwo) {
  LaidParts food;
  const auto apart = [](int part) { return 3.0 * part; };
  food.lay(kHalves, apart);
  EXPECT_LT(food.join(), 0.0);
  EXPECT_EQ(food.count(), 2);
  // Only parts of so many blocks tell whether the number of items is in doubt.
  food.lay(kHalves, apart);
  EXPECT_EQ(food.join(1000), kNone);
}

// Peas and carrots in each other's gaps are one item; the same beside each other are two.
TEST(PartJoining, WhatIsInterleavedIsOneItem) {
  const auto apart = [](int part) { return 1.7 * part; };
  LaidParts food;
  food.lay([](int x, int y) { return x < 8 + (y % 4 < 2 ? 2 : -2) ? 0 : 1; }, apart);
  food.join();
  EXPECT_EQ(food.count(), 1);
  food.lay([](int x, int y) { return y > 9 ? -1 : x < 2 ? 0 : 1; }, apart);
  food.join();
  EXPECT_EQ(food.count(), 1);
  food.lay([](int x, int y) { return y > 1 ? -1 : x < 8 ? 0 : 1; }, apart);
  food.join();
  EXPECT_EQ(food.count(), 2);
}

// A steak on mash lies within the mash from all sides, and is no mash.
TEST(PartJoining, WhatReadsDifferentlyWithinAnotherStaysApart) {
  LaidParts food;
  const auto within = [](int x, int y) { return x > 4 && x < 10 && y > 3 && y < 8 ? 1 : 0; };
  food.lay(within, [](int part) { return 2.2 * part; });
  food.join();
  EXPECT_EQ(food.count(), 2);
  food.lay(within, [](int part) { return 1.5 * part; });
  food.join();
  EXPECT_EQ(food.count(), 1);
}

TEST(PartJoining, WhatDoesNotMeetStaysApart) {
  LaidParts food;
  food.lay([](int x, int) { return x < 7 ? 0 : x > 8 ? 1 : -1; }, kOnePlace);
  EXPECT_EQ(food.join(), kNone);
  EXPECT_EQ(food.count(), 2);
  EXPECT_FALSE(food.are_one(0, 0, 15, 0));
}

TEST(PartJoining, NoFoodIsNoItem) {
  LaidParts food;
  food.lay([](int, int) { return -1; }, kOnePlace);
  EXPECT_EQ(food.join(), kNone);
  EXPECT_EQ(food.count(), 0);
}

// Parts at random: joining keeps every block and every sum, and tears none.
TEST(PartJoining, KeepsAllSums) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> place(0.0, 6.0);
  const auto part_at = [](int x, int y) { return x / 4 + 4 * (y / 4); };
  int joined = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<double> places(12);
    for (double& p : places) p = place(random);
    LaidParts food;
    food.lay(part_at, [&](int part) { return places[static_cast<std::size_t>(part)]; });
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
    EXPECT_NEAR(luma, 16.0F * 66.0F, 0.5F);
    for (int y = 0; y < kPartRows; ++y) {
      for (int x = 0; x < kPartColumns; ++x) EXPECT_TRUE(food.are_one(x, y, x / 4 * 4, y / 4 * 4));
    }
  }
  EXPECT_GT(joined, 40);
}

}  // namespace
}  // namespace traygauge
