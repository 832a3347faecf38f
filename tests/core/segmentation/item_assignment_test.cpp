// Rasters of cells drawn at random from two foods that share a colour; whose cell is whose is known.
#include "core/segmentation/item_assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "core/segmentation/geodesic.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kSide = 120;  // cells of a millimetre
constexpr std::uint8_t kUnknown = 251;
constexpr std::uint8_t kLeft = kFirstItemLabel;
constexpr std::uint8_t kRight = kFirstItemLabel + 3;  // labels need not be in a row

class TwoFoods {
 public:
  explicit TwoFoods(std::uint32_t seed) : random_(seed), colours_(kSide * kSide), cells_(kSide * kSide) {
    raster.colours = {colours_.data(), kSide, kSide};
    cells = {cells_.data(), kSide, kSide};
    std::fill(cells_.begin(), cells_.end(), kGlazeSeed);
  }

  // Of either food a half has the colour that they share.
  void paint(int border) {
    std::bernoulli_distribution is_shared(0.5);
    std::normal_distribution<double> noise(0.0, 2.0);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const int own = x < border ? 30 : -30;
        const int red = is_shared(random_) ? 0 : own;
        raster_colour(x, y) = {static_cast<std::uint8_t>(120.0 + 10.0 * noise(random_)),
                               static_cast<std::uint8_t>(100.0 + red + noise(random_)),
                               static_cast<std::uint8_t>(100.0 - 0.5 * red + noise(random_))};
      }
    }
  }

  // Food within 16 cells of the raster's border; on its left side one label, then another.
  void label(int border) {
    for (int y = 16; y < kSide - 16; ++y) {
      for (int x = 16; x < kSide - 16; ++x) cells.at(x, y) = x < border ? kLeft : kRight;
    }
  }

  void assign(const ItemAssignmentParams& params = {}) {
    test::Allocated<ItemAssignmentWorkspace> memory(kSide * kSide, params);
    assign_items(raster, kUnknown, params, *memory, cells);
  }

  DishRaster raster;
  ImageView<std::uint8_t> cells;

 private:
  CellColour& raster_colour(int x, int y) { return colours_[static_cast<std::size_t>(y * kSide + x)]; }

  std::mt19937 random_;
  std::vector<CellColour> colours_;
  std::vector<std::uint8_t> cells_;
};

struct Tally {
  int right = 0;
  int wrong = 0;
  int unknown = 0;
};

Tally tally(ImageView<const std::uint8_t> cells, int border) {
  Tally tally;
  for (int y = 16; y < kSide - 16; ++y) {
    for (int x = 16; x < kSide - 16; ++x) {
      const std::uint8_t cell = cells.at(x, y);
      if (cell == kUnknown) {
        ++tally.unknown;
      } else {
        ++(cell == (x < border ? kLeft : kRight) ? tally.right : tally.wrong);
      }
    }
  }
  return tally;
}

TEST(ItemAssignment, BorderMovesToWhereTheColoursChange) {
  const std::uint32_t seed = test::random_seed();
  SCOPED_TRACE(seed);
  for (const int drawn : {46, 54, 60, 66, 74}) {
    TwoFoods foods(seed);
    foods.paint(60);
    foods.label(drawn);
    foods.assign();
    const Tally found = tally(foods.cells, 60);
    EXPECT_LT(found.wrong, 0.02 * found.right) << "border drawn at " << drawn;
    EXPECT_LT(found.unknown, 88 * 16) << "border drawn at " << drawn;
    EXPECT_GT(found.unknown, 88 * 2) << "next to the border nothing is known";
  }
}

TEST(ItemAssignment, SeedsSpread) {
  const std::uint32_t seed = test::random_seed();
  SCOPED_TRACE(seed);
  TwoFoods foods(seed);
  foods.paint(60);
  foods.label(60);
  for (int y = 16; y < kSide - 16; ++y) {
    for (int x = 16; x < kSide - 16; ++x) {
      if (x % 4 != 0 || y % 4 != 0 || (x > 36 && x < 84)) foods.cells.at(x, y) = kUnknown;
    }
  }
  foods.assign();
  const Tally found = tally(foods.cells, 60);
  EXPECT_LT(found.wrong, 0.02 * found.right);
  EXPECT_LT(found.unknown, 88 * 20);
}

TEST(ItemAssignment, OneItemStaysAsItIs) {
  TwoFoods foods(1);
  foods.paint(60);
  foods.label(0);
  foods.cells.at(50, 50) = kUnknown;
  foods.assign();
  for (int y = 16; y < kSide - 16; ++y) {
    for (int x = 16; x < kSide - 16; ++x)
      ASSERT_EQ(foods.cells.at(x, y), x == 50 && y == 50 ? kUnknown : kRight) << x << ", " << y;
  }
}

TEST(ItemAssignment, NoRoundKeepsTheBorder) {
  TwoFoods foods(1);
  foods.paint(60);
  foods.label(50);
  ItemAssignmentParams params;
  params.rounds = 0;
  foods.assign(params);
  EXPECT_EQ(tally(foods.cells, 50).wrong, 0);
}

TEST(ItemAssignment, WhatIsFarAwayStaysAnItemOfItsOwn) {
  TwoFoods foods(1);
  foods.paint(0);  // all of one food
  foods.label(60);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 40; x < 80; ++x) foods.cells.at(x, y) = kGlazeSeed;
  }
  foods.assign();
  EXPECT_EQ(foods.cells.at(25, 60), kLeft);
  EXPECT_EQ(foods.cells.at(95, 60), kRight);
  EXPECT_EQ(tally(foods.cells, 60).unknown, 0);
}

TEST(ItemAssignment, GlazeIsNeverLabelled) {
  const std::uint32_t seed = test::random_seed();
  SCOPED_TRACE(seed);
  TwoFoods foods(seed);
  foods.paint(60);
  std::mt19937 random(seed);
  std::vector<std::uint8_t> before;
  const std::vector<std::uint8_t> values{kGlazeSeed, kBarred, kUnknown, kLeft, kRight};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      foods.cells.at(x, y) = values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
      before.push_back(foods.cells.at(x, y));
    }
  }
  foods.assign();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::uint8_t cell = foods.cells.data[i];
    if (before[i] == kGlazeSeed || before[i] == kBarred) {
      ASSERT_EQ(cell, before[i]);
    } else {
      ASSERT_TRUE(cell == kUnknown || cell == kLeft || cell == kRight) << static_cast<int>(cell);
    }
  }
}

}  // namespace
}  // namespace traygauge
