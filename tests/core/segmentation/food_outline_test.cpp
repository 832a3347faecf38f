// Food drawn on a plate: where it is and of how many items is known.
#include "core/segmentation/food_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/core/segmentation/drawn_plate.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

using test::Disc;
using test::kBrown;
using test::kGreen;
using test::kOchre;
using test::kOrange;
using test::kPxPerMm;
using test::kWhite;
using test::of_food;
using test::Plate;
using test::with_margin;

TEST(FoodOutline, EmptyPlateHasNoFood) {
  Plate plate({}, 0.25);
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  EXPECT_EQ(plate.outline(labels, raster), 0);
  EXPECT_EQ(plate.right_fraction(labels, raster), 1.0);
}

TEST(FoodOutline, PilesApartAreItemsOfTheirOwn) {
  Plate plate({{220, 250, 60, kGreen}, {390, 330, 70, kGreen}});
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  EXPECT_EQ(plate.outline(labels, raster), 2);
  EXPECT_GT(plate.right_fraction(labels, raster), 0.995);
}

TEST(FoodOutline, TwoFoodsThatTouchAreTwoItems) {
  Plate plate({{240, 300, 70, kGreen}, of_food(1, {365, 300, 65, kBrown})});
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  EXPECT_EQ(plate.outline(labels, raster), 2);
  const auto label_at = [&](double x, double y) {
    const Vec2 cell = raster.cell_of({x, y});
    return labels[static_cast<std::size_t>(std::lround(cell.y()) * raster.width() + std::lround(cell.x()))];
  };
  EXPECT_NE(label_at(240, 300), label_at(380, 300));
  EXPECT_EQ(label_at(200, 280), label_at(285, 300));
  EXPECT_EQ(label_at(320, 300), label_at(400, 340));
  EXPECT_GT(plate.item_fraction(labels, raster), 0.99);
}

TEST(FoodOutline, CrumbsAndLinesOfDecorationAreNoFood) {
  std::vector<Disc> crumbs;
  for (int i = 0; i < 12; ++i) crumbs.push_back({100.0 + 33.0 * i, 200.0 + 10.0 * i, 5.0, kBrown});
  Plate plate(crumbs);
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  EXPECT_EQ(plate.outline(labels, raster), 0);
}

// A network that takes it for glaze without a doubt.
TEST(FoodOutline, FoodOfTheGlazesColourIsToldByItsHeight) {
  const Disc mash = with_margin(-3.9, {260, 310, 80, kWhite, 20.0, 14});
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate plate({mash});
  EXPECT_EQ(plate.outline(labels, raster), 1);
  EXPECT_GT(plate.right_fraction(labels, raster), 0.96);
  EXPECT_TRUE(plate.is_told_by_height());
  Plate blind({mash}, 0.1, false);
  EXPECT_EQ(blind.outline(labels, raster), 0);
  EXPECT_FALSE(blind.is_told_by_height());
}

// The white of a fried egg: of little grain, so that its height is seen well in places only.
TEST(FoodOutline, FoodThatTheNetworkDeniesIsFoundInWhole) {
  Disc smooth = with_margin(-3.9, {300, 300, 90, kWhite, 20.0});
  smooth.lift_bits = 2.0;
  Disc grainy = with_margin(-3.9, {320, 300, 40, kWhite, 20.0});
  grainy.lift_bits = 9.0;
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate egg({smooth, grainy});
  EXPECT_EQ(egg.outline(labels, raster), 1);
  EXPECT_GT(egg.right_fraction(labels, raster), 0.98);
  EXPECT_TRUE(egg.is_told_by_height());
  // Without a place that surely stands the network is believed.
  Plate glaze({smooth});
  EXPECT_EQ(glaze.outline(labels, raster), 0);
}

// Yoghurt in a white bowl, or the foot of a heap of white rice: neither colour nor height tells it.
TEST(FoodOutline, LowFoodOfTheGlazesColourIsToldByTheNetwork) {
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  const Disc rice{260, 310, 80, kWhite, 1.0};
  Plate known({with_margin(3.9, rice)}, 0.1, false);
  EXPECT_EQ(known.outline(labels, raster), 1);
  EXPECT_GT(known.right_fraction(labels, raster), 0.97);
  Plate unknown({rice}, 0.1, false);
  EXPECT_EQ(unknown.outline(labels, raster), 0);
}

TEST(FoodOutline, AShadowsBorderIsNoFood) {
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate plate({{260, 310, 80, {150, 153, 157}, 0.0}});
  EXPECT_EQ(plate.outline(labels, raster), 0);
}

// Beside food that hides the dish from the other view, any height is matched better than the dish.
TEST(FoodOutline, GlazeWhoseHeightOnlyOneViewFoundIsNoFood) {
  Disc seen{260, 310, 80, kWhite, 20.0, 14};
  Disc hidden = seen;
  hidden.is_agreed = false;
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate agreed({seen});
  EXPECT_EQ(agreed.outline(labels, raster), 1);
  Plate plate({hidden});
  EXPECT_EQ(plate.outline(labels, raster), 0);
}

// What food reflects into its shade has a colour, and nothing to match.
TEST(FoodOutline, GlazeTintedByFoodIsToldByTheNetwork) {
  constexpr std::array<int, 3> kTint = {180, 205, 228};
  const Disc tinted{400, 350, 60, kTint, 0.0};
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate plate({{220, 250, 60, kBrown}, with_margin(-4.0, tinted)}, 0.1, false);
  EXPECT_EQ(plate.outline(labels, raster), 1);
  Plate unknown({{220, 250, 60, kBrown}, with_margin(3.0, tinted)}, 0.1, false);
  EXPECT_EQ(unknown.outline(labels, raster), 2);
}

TEST(FoodOutline, MixedPiecesAreOneItem) {
  const std::vector<Disc> discs = {{220, 260, 85, kOrange, 20.0, 0, kGreen}, {410, 340, 70, kBrown}};
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  Plate plate(discs);
  EXPECT_EQ(plate.outline(labels, raster), 2);
}

// A steak on mash, and the yolk of a fried egg.
TEST(FoodOutline, WhatLiesWithinAnItemIsItsOwnOnlyWhereItIsAnotherFood) {
  std::vector<std::uint8_t> labels;
  DishRaster raster;
  const Disc below{300, 300, 110, kBrown, 15.0};
  const Disc upon{300, 300, 50, kOchre, 25.0};
  Plate egg({below, upon});
  EXPECT_EQ(egg.outline(labels, raster), 1);
  Plate steak({below, of_food(1, upon)});
  EXPECT_EQ(steak.outline(labels, raster), 2);
}

TEST(FoodOutline, NoFlangeNoAnswer) {
  DishRasterParams params;
  test::Allocated<FoodOutlineWorkspace> memory{FoodOutlineParams{}};
  const std::vector<std::uint8_t> pixels(std::size_t{3} * 64 * 64, 200);
  const FrameView frame{pixels.data(), 64, 64, 3 * 64, PixelFormat::bgr8};
  const std::vector<Vec2> box = {{0, 0}, {63, 0}, {63, 63}, {0, 63}};
  DishRaster raster;
  ASSERT_TRUE(load_dish_raster(frame, box, kPxPerMm, params, memory->raster, raster));
  std::vector<std::uint8_t> labels(static_cast<std::size_t>(raster.width() * raster.height()));
  const std::vector<HeightSample> relief(labels.size());
  const test::DrawnReading reading(64, 8);
  const PictureReading read = reading.view();
  EXPECT_FALSE(outline_food({raster, {relief.data(), raster.width(), raster.height()}, read}, {}, *memory,
                            {labels.data(), raster.width(), raster.height()})
                   .is_outlined);
}

// Without an outline's cost every cell is what its own evidence says; with a great one all are alike.
TEST(FoodField, OutlineCostDecidesHowFarCellsAgree) {
  constexpr int kWide = 40;
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<CellColour> colours(kWide * kWide, {200, 170, 170});
    std::vector<DishZone> zones(colours.size(), DishZone::inside);
    std::vector<HeightSample> relief(colours.size());
    int lifted = 0;
    for (HeightSample& sample : relief) {
      const bool is_lifted = random() % 3 == 0;
      sample = {40, 10, static_cast<std::uint8_t>(is_lifted ? 60 : 10), true, true};
      lifted += is_lifted ? 1 : 0;
    }
    DishRaster raster;
    raster.colours = {colours.data(), kWide, kWide};
    raster.zones = {zones.data(), kWide, kWide};
    TvSegmentationParams params;
    params.fold = 1;
    params.sweeps = 400;
    // No cell has a margin or a colour that speaks.
    FoodWeights weights = params.evidence.usual();
    weights.constant = -params.evidence.least_colour * weights.colour - 0.5 * weights.lift;
    const test::DrawnReading reading(kWide, 8);
    const PictureReading read = reading.view();
    const GlazeColour glaze{170, 170, 4.0};
    test::Allocated<TvSegmentationWorkspace> memory{kWide * kWide};
    std::vector<std::uint8_t> cells(colours.size());
    const auto count_food = [&] {
      segment_food({raster, {relief.data(), kWide, kWide}, read}, glaze, weights, params, *memory,
                   {cells.data(), kWide, kWide});
      return static_cast<int>(std::count(cells.begin(), cells.end(), kFoodSeed));
    };
    params.outline = 0.0;
    EXPECT_EQ(count_food(), lifted);
    params.outline = 50.0;
    EXPECT_EQ(count_food(), 0);
  }
}

// Against the shortest ways by relaxing every cell until nothing changes.
TEST(Geodesic, OwnersAreThoseOfTheShortestWay) {
  constexpr int kWidth = 23;
  constexpr int kHeight = 17;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<CellColour> colours(kWidth * kHeight);
    for (CellColour& colour : colours)
      colour = {static_cast<std::uint8_t>(random() % 60), static_cast<std::uint8_t>(random() % 20), 100};
    std::vector<std::uint8_t> owners(colours.size(), kNoOwner);
    for (int i = 0; i < 4; ++i) owners[random() % owners.size()] = static_cast<std::uint8_t>(1 + i);
    for (int i = 0; i < 60; ++i) owners[random() % owners.size()] = kBarred;
    const std::vector<std::uint8_t> seeds = owners;
    test::Allocated<GeodesicWorkspace> memory{kWidth * kHeight};
    spread_owners({colours.data(), kWidth, kHeight}, *memory, {owners.data(), kWidth, kHeight});

    const auto cost = [&](int a, int b) {
      const auto& p = colours[static_cast<std::size_t>(a)];
      const auto& q = colours[static_cast<std::size_t>(b)];
      const int luma = p.luma - q.luma;
      const int red = p.red - q.red;
      const int squares = luma * luma + 4 * red * red;
      return std::min(1 + squares / 16, kMaxGeodesicStep);
    };
    for (int label = 1; label <= 4; ++label) {
      std::vector<int> distance(colours.size(), 1 << 20);
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (seeds[i] == label) distance[i] = 0;
      }
      for (bool changed = true; changed;) {
        changed = false;
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            const int cell = y * kWidth + x;
            const auto at = static_cast<std::size_t>(cell);
            if (seeds[at] == kBarred) continue;
            for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
              if (x + dx < 0 || y + dy < 0 || x + dx >= kWidth || y + dy >= kHeight) continue;
              const int other = cell + dy * kWidth + dx;
              const int way = distance[static_cast<std::size_t>(other)] + cost(cell, other);
              if (way >= distance[at]) continue;
              distance[at] = way;
              changed = true;
            }
          }
        }
      }
      // No label comes nearer than the one that owns the cell.
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (seeds[i] == kBarred) {
          EXPECT_EQ(owners[i], kBarred);
        } else if (owners[i] == label) {
          EXPECT_EQ(memory->distance[i], distance[i]);
        } else if (owners[i] != kNoOwner) {
          EXPECT_LE(memory->distance[i], distance[i]);
        } else {
          EXPECT_GE(distance[i], 1 << 20);
        }
      }
    }
  }
}

}  // namespace
}  // namespace traygauge
