// Squares of a dish that stand above it, drawn by hand.
#include "core/segmentation/standing_food.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/segmentation/geodesic.hpp"

namespace traygauge {
namespace {

constexpr int kSideCells = 120;  // of a millimetre
constexpr double kLeastMm2 = 250.0;
constexpr HeightSample kStanding{24, 10, 40, true, true};
constexpr HeightSample kOnGlaze{0, 10, 10, true, true};

// A dish that fills the raster but for an edge, without food that anything else tells.
class StandingThings {
 public:
  StandingThings() {
    raster_.zones = {zones_.data(), kSideCells, kSideCells};
    raster_.colours = {colours_.data(), kSideCells, kSideCells};
    for (int i = 0; i < kSideCells; ++i) {
      for (const auto& [x, y] :
           {std::pair(i, 0), std::pair(i, kSideCells - 1), std::pair(0, i), std::pair(kSideCells - 1, i)})
        zones_[at(x, y)] = DishZone::edge;
    }
  }

  void stand(int left, int top, int width, int height) {
    for (int y = top; y < top + height; ++y) std::fill_n(&relief_[at(left, y)], width, kStanding);
  }
  HeightSample& sample(int x, int y) { return relief_[at(x, y)]; }

  bool add() {
    return add_standing_food(raster_, {relief_.data(), kSideCells, kSideCells}, {}, {}, kLeastMm2,
                             {row_sums_, column_sums_, queue_}, {cells_.data(), kSideCells, kSideCells});
  }
  std::ptrdiff_t count(std::uint8_t value) const { return std::count(cells_.begin(), cells_.end(), value); }
  std::uint8_t cell(int x, int y) const { return cells_[at(x, y)]; }

 private:
  static constexpr std::size_t at(int x, int y) { return static_cast<std::size_t>(y * kSideCells + x); }

  static constexpr std::size_t kCells = std::size_t{kSideCells} * kSideCells;
  DishRaster raster_;
  std::vector<DishZone> zones_ = std::vector<DishZone>(kCells, DishZone::inside);
  std::vector<CellColour> colours_ = std::vector<CellColour>(kCells);
  std::vector<HeightSample> relief_ = std::vector<HeightSample>(kCells, kOnGlaze);
  std::vector<std::uint8_t> cells_ = std::vector<std::uint8_t>(kCells, kGlazeSeed);
  std::vector<std::uint8_t> row_sums_ = std::vector<std::uint8_t>(kCells);
  std::vector<std::int32_t> column_sums_ = std::vector<std::int32_t>(kSideCells);
  std::vector<std::int32_t> queue_ = std::vector<std::int32_t>(kCells);
};

TEST(StandingFood, IsAddedUpToItsBorder) {
  StandingThings dish;
  dish.stand(20, 30, 40, 30);
  EXPECT_TRUE(dish.add());
  // A square that reaches over the border by a cell still stands by nine tenths.
  EXPECT_GE(dish.count(kStandingFood), 40 * 30);
  EXPECT_LE(dish.count(kStandingFood), 42 * 32);
  EXPECT_EQ(dish.count(kStandingFood) + dish.count(kGlazeSeed), kSideCells * kSideCells);
  EXPECT_EQ(dish.cell(40, 45), kStandingFood);
  EXPECT_EQ(dish.cell(63, 45), kGlazeSeed);
}

// Bands are reflections on a wall; what is small is a crumb, a drop or a highlight.
TEST(StandingFood, IsNoBandAndNothingSmall) {
  StandingThings dish;
  EXPECT_FALSE(dish.add());
  dish.stand(10, 20, 100, 9);
  dish.stand(20, 50, 20, 20);
  EXPECT_FALSE(dish.add());
  EXPECT_EQ(dish.count(kGlazeSeed), kSideCells * kSideCells);
}

// The edge stands over what the other view shows behind it.
TEST(StandingFood, IsNotTheEdge) {
  StandingThings dish;
  dish.stand(0, 0, kSideCells, 10);
  EXPECT_FALSE(dish.add());
}

TEST(StandingFood, IsConfirmedByTheOtherView) {
  StandingThings dish;
  dish.stand(20, 30, 40, 30);
  for (int y = 30; y < 60; ++y) {
    for (int x = 20; x < 60; x += 4) dish.sample(x, y).is_confirmed = false;
  }
  EXPECT_FALSE(dish.add());
}

}  // namespace
}  // namespace traygauge
