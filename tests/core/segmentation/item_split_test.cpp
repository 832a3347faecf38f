// Blocks of food, laid out by hand: which of them are one item.
#include "core/segmentation/item_split.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tests/core/segmentation/drawn_reading.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

constexpr int kWide = 140;
constexpr int kSide_mm = 7;
constexpr std::uint8_t kFood = 250;
constexpr CellColour kDark = {60, 120, 70};
constexpr CellColour kPale = {150, 135, 95};
constexpr CellColour kGreenish = {90, 80, 140};

// Of cells of a millimetre, which a pixel shows.
class Food {
 public:
  Food() : colours_(kWide * kWide), owners_(colours_.size(), kGlaze), foods_(colours_.size(), -1) {}

  // Of blocks from (left, top); `food` says which it is to the network.
  void add(int left, int top, int columns, int rows, const CellColour& colour, int food) {
    for (int y = kSide_mm * top; y < kSide_mm * (top + rows); ++y) {
      for (int x = kSide_mm * left; x < kSide_mm * (left + columns); ++x) {
        const auto at = static_cast<std::size_t>(y * kWide + x);
        colours_[at] = colour;
        owners_[at] = kFood;
        foods_[at] = food;
      }
    }
  }
  // Likewise, cells of two colours in an order without a pattern.
  void mix(int left, int top, int columns, int rows, const CellColour& a, const CellColour& b, int food) {
    add(left, top, columns, rows, b, food);
    std::mt19937 random(1);
    for (int y = kSide_mm * top; y < kSide_mm * (top + rows); ++y) {
      for (int x = kSide_mm * left; x < kSide_mm * (left + columns); ++x) {
        if (random() % 2U == 0U) colours_[static_cast<std::size_t>(y * kWide + x)] = a;
      }
    }
  }
  // Embeddings of two foods lie `apart` from each other.
  ItemSplit split(double apart = 3.0) {
    DishRaster raster;
    raster.colours = {colours_.data(), kWide, kWide};
    test::DrawnReading reading(kWide, 2);
    reading.draw([](const Vec2&) { return 0.0; },
                 [&](const Vec2& pixel, int channel) {
                   const auto at = static_cast<std::size_t>(static_cast<int>(pixel.y()) * kWide +
                                                            static_cast<int>(pixel.x()));
                   return foods_[at] == channel ? apart / std::numbers::sqrt2 : 0.0;
                 });
    return split_items(raster, reading.view(), kFood, params_, *memory_, 2, 100,
                       {owners_.data(), kWide, kWide});
  }
  std::uint8_t owner(int column, int row) const {
    return owners_[static_cast<std::size_t>((kSide_mm * row + 3) * kWide + kSide_mm * column + 3)];
  }

 private:
  static constexpr std::uint8_t kGlaze = 251;
  std::vector<CellColour> colours_;
  std::vector<std::uint8_t> owners_;
  std::vector<int> foods_;
  ItemSplitParams params_;
  test::Allocated<ItemSplitWorkspace> memory_{ItemSplitParams{}};
};

// A piece of cake: its top, and the side that is seen beside it.
TEST(ItemSplit, PartsOfTwoColoursOfOneFoodAreOneItem) {
  Food cake;
  cake.add(2, 4, 6, 6, kDark, 0);
  cake.add(8, 4, 3, 6, kPale, 0);
  const ItemSplit split = cake.split();
  EXPECT_EQ(split.items, 1);
  EXPECT_EQ(split.most_alike, -std::numeric_limits<double>::infinity());
}

TEST(ItemSplit, TwoFoodsOfOneColourAreTwo) {
  Food food;
  food.add(2, 4, 6, 6, kDark, 0);
  food.add(8, 4, 4, 6, kDark, 1);
  EXPECT_EQ(food.split().items, 2);
}

// Vegetables in sauce.
TEST(ItemSplit, MixedFoodIsOneItem) {
  Food food;
  food.mix(2, 2, 12, 8, kDark, kPale, 0);
  EXPECT_EQ(food.split().items, 1);
}

TEST(ItemSplit, MixedFoodsThatShareAColourAreTwo) {
  Food food;
  food.mix(2, 2, 6, 8, kDark, kPale, 0);
  food.mix(8, 2, 6, 8, kDark, kGreenish, 1);
  EXPECT_EQ(food.split().items, 2);
}

TEST(ItemSplit, ItemsAreTheMoreAlikeTheNearerTheyAreToBeingOne) {
  const auto split = [](double apart) {
    Food food;
    food.add(2, 2, 6, 8, kDark, 0);
    food.add(8, 2, 6, 8, kGreenish, 1);
    return food.split(apart);
  };
  const ItemSplit far = split(3.5);
  const ItemSplit near = split(2.6);
  ASSERT_EQ(far.items, 2);
  ASSERT_EQ(near.items, 2);
  EXPECT_LT(far.most_alike, near.most_alike);
  EXPECT_LT(near.most_alike, 0.0);
  EXPECT_EQ(split(0.5).items, 1);
}

TEST(ItemSplit, CellsWhereTwoFoodsMeetAreLeftToThePicture) {
  Food food;
  food.add(2, 2, 6, 8, kDark, 0);
  food.add(8, 2, 6, 8, kGreenish, 1);
  EXPECT_EQ(food.split().items, 2);
  for (const int column : {7, 8}) EXPECT_EQ(food.owner(column, 5), kFood) << column;
  EXPECT_NE(food.owner(4, 5), food.owner(11, 5));
}

}  // namespace
}  // namespace traygauge
