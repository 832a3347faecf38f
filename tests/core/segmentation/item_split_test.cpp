// Blocks of food, laid out by hand: which of them are one item.
#include "core/segmentation/item_split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

constexpr int kWide = 140;
constexpr int kSide_mm = 7;
constexpr std::uint8_t kFood = 250;
constexpr CellColour kDark = {60, 120, 70};
constexpr CellColour kPale = {150, 135, 95};
constexpr CellColour kBright = {170, 150, 115};
constexpr CellColour kGreenish = {90, 80, 140};

class Food {
 public:
  Food()
      : colours_(kWide * kWide),
        zones_(colours_.size(), DishZone::inside),
        relief_(colours_.size()),
        owners_(colours_.size(), kGlaze) {}

  // Of blocks from (left, top), as high as `height_mm` says at every column.
  template <class HeightOf>
  void add(int left, int top, int columns, int rows, const CellColour& colour, HeightOf&& height_mm) {
    for (int y = kSide_mm * top; y < kSide_mm * (top + rows); ++y) {
      for (int x = kSide_mm * left; x < kSide_mm * (left + columns); ++x) {
        const auto at = static_cast<std::size_t>(y * kWide + x);
        colours_[at] = colour;
        owners_[at] = kFood;
        relief_[at].height = static_cast<std::int8_t>(height_mm(x - kSide_mm * left) / kHeightUnitMm);
        relief_[at].is_known = relief_[at].is_confirmed = true;
      }
    }
  }
  // Likewise, cells of two colours in an order without a pattern, of which the first has `share_of(column)`.
  template <class ShareOf, class HeightOf>
  void mix(int left, int top, int columns, int rows, const CellColour& a, const CellColour& b,
           ShareOf&& share_of, HeightOf&& height_mm) {
    add(left, top, columns, rows, b, height_mm);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> draw;
    for (int y = kSide_mm * top; y < kSide_mm * (top + rows); ++y) {
      for (int x = kSide_mm * left; x < kSide_mm * (left + columns); ++x) {
        if (draw(random) < share_of(x / kSide_mm - left))
          colours_[static_cast<std::size_t>(y * kWide + x)] = a;
      }
    }
  }
  int split() { return split_all().items; }
  ItemSplit split_all() {
    DishRaster raster;
    raster.colours = {colours_.data(), kWide, kWide};
    raster.zones = {zones_.data(), kWide, kWide};
    return split_items(raster, {relief_.data(), kWide, kWide}, kFood, 1.0, params_, *memory_, 2, 100,
                       {owners_.data(), kWide, kWide});
  }
  std::uint8_t owner(int column, int row) const {
    return owners_[static_cast<std::size_t>((kSide_mm * row + 3) * kWide + kSide_mm * column + 3)];
  }

 private:
  static constexpr std::uint8_t kGlaze = 251;
  std::vector<CellColour> colours_;
  std::vector<DishZone> zones_;
  std::vector<HeightSample> relief_;
  std::vector<std::uint8_t> owners_;
  ItemSplitParams params_;
  test::Allocated<ItemSplitWorkspace> memory_{ItemSplitParams{}};
};

// A piece of cake: its top, and the side that is seen beside it.
TEST(ItemSplit, TheSideOfWhatStandsBelongsToIt) {
  Food cake;
  cake.add(2, 4, 6, 6, kDark, [](int) { return 34.0; });
  cake.add(8, 4, 3, 6, kPale, [](int x) { return 31.0 - 1.4 * x; });
  EXPECT_EQ(cake.split(), 1);
}

TEST(ItemSplit, AFlatFoodBesideAHighOneIsItsOwn) {
  Food food;
  food.add(2, 4, 6, 6, kDark, [](int) { return 34.0; });
  food.add(8, 4, 4, 6, kPale, [](int) { return 12.0; });
  EXPECT_EQ(food.split(), 2);
}

// A schnitzel and a chicken leg: as brown, but for what tells parts of one food as well.
TEST(ItemSplit, FoodsOfOneColourAreTwoWhereOneIsFarHigher) {
  constexpr CellColour kNearlyDark = {66, 121, 71};
  const auto split = [&](double first_mm, double second_mm) {
    Food food;
    food.add(2, 4, 6, 6, kDark, [&](int) { return first_mm; });
    food.add(8, 8, 6, 6, kNearlyDark, [&](int) { return second_mm; });
    return food.split();
  };
  EXPECT_EQ(split(30.0, 12.0), 2);
  EXPECT_EQ(split(12.0, 30.0), 2);
  EXPECT_EQ(split(20.0, 12.0), 1);
}

TEST(ItemSplit, FoodsThatSinkTowardsEachOtherAreTwo) {
  Food food;
  food.add(2, 4, 5, 6, kDark, [](int x) { return 34.0 - 0.8 * std::max(0, x - 7); });
  food.add(7, 4, 5, 6, kPale, [](int x) { return 8.0 + 0.8 * std::min(28, x); });
  EXPECT_EQ(food.split(), 2);
}

// Vegetables in sauce: of each there is more in one place than in another.
TEST(ItemSplit, MixedFoodIsOneItem) {
  Food food;
  food.mix(
      2, 2, 12, 8, kDark, kPale, [](int column) { return column % 6 < 3 ? 0.65 : 0.35; },
      [](int) { return 15.0; });
  EXPECT_EQ(food.split(), 1);
}

TEST(ItemSplit, MixedFoodsThatShareAColourAreTwo) {
  const auto half = [](int) { return 0.5; };
  Food food;
  food.mix(2, 2, 6, 8, kDark, kPale, half, [](int x) { return 20.0 - 0.4 * std::max(0, x - 20); });
  food.mix(8, 2, 6, 8, kDark, kGreenish, half, [](int x) { return 12.0 + 0.4 * std::min(20, x); });
  EXPECT_EQ(food.split(), 2);
}

// Of two mixed foods the second has more and more of the first one's colour, until they are one.
TEST(ItemSplit, ItemsAreTheMoreAlikeTheNearerTheyAreToBeingOne) {
  const auto half = [](int) { return 0.5; };
  const auto split = [&](std::uint8_t green) {
    Food food;
    food.mix(2, 2, 6, 8, kDark, kPale, half, [](int x) { return 20.0 - 0.4 * std::max(0, x - 20); });
    food.mix(8, 2, 6, 8, kDark, {90, 80, green}, half, [](int x) { return 12.0 + 0.4 * std::min(20, x); });
    return food.split_all();
  };
  const ItemSplit far = split(160);
  const ItemSplit near = split(110);
  ASSERT_EQ(far.items, 2);
  ASSERT_EQ(near.items, 2);
  EXPECT_LT(far.most_alike, near.most_alike);
  EXPECT_LT(near.most_alike, 0.0);
}

// As mixed as parts of one food are, but far higher on one side: joined, and in doubt where both are large.
TEST(ItemSplit, AJoinOfTwoLargePartsIsInDoubtWhereOneIsFarHigher) {
  const auto split = [](int columns, double second_mm) {
    Food food;
    food.mix(
        2, 2, columns, 8, kDark, kPale, [](int) { return 0.6; }, [](int) { return 30.0; });
    food.mix(
        2 + columns, 2, columns, 8, kDark, kPale, [](int) { return 0.4; }, [&](int) { return second_mm; });
    return food.split_all();
  };
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const ItemSplit high = split(7, 12.0);
  EXPECT_EQ(high.items, 1);
  EXPECT_EQ(high.most_alike, 0.0);
  const ItemSplit level = split(7, 20.0);
  EXPECT_EQ(level.items, 1);
  EXPECT_EQ(level.most_alike, kNone);
  const ItemSplit small = split(4, 12.0);
  EXPECT_EQ(small.items, 1);
  EXPECT_EQ(small.most_alike, kNone);
}

TEST(ItemSplit, OneItemIsLikeNoOther) {
  Food food;
  food.add(2, 4, 6, 6, kDark, [](int) { return 34.0; });
  const ItemSplit split = food.split_all();
  EXPECT_EQ(split.items, 1);
  EXPECT_EQ(split.most_alike, -std::numeric_limits<double>::infinity());
}

// A row of blocks between two foods, half of either, is neither's colour.
TEST(ItemSplit, WhereTwoFoodsMixThereIsNoThird) {
  const auto height_mm = [](int) { return 15.0; };
  Food food;
  food.add(2, 2, 6, 8, kDark, height_mm);
  food.add(8, 2, 1, 8, kBright, height_mm);
  food.add(9, 2, 6, 8, kGreenish, height_mm);
  EXPECT_EQ(food.split(), 2);
  // What both meet in is left to the picture's colours, cell by cell.
  for (const int column : {7, 8, 9}) EXPECT_EQ(food.owner(column, 5), kFood) << column;
  EXPECT_NE(food.owner(4, 5), food.owner(12, 5));
}

}  // namespace
}  // namespace traygauge
