#include "firmware/handover/cell_outlines.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tests/firmware/handover/drawn_tray.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

// Positive where the outline goes counter-clockwise.
double area_mm2(const Outline& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

TEST(CellOutlines, OfADiscIsACircle) {
  const DrawnTray tray;
  const std::vector<Outline> outlines = outline_label(tray.heights(), DrawnTray::kFood, 0.5);
  ASSERT_EQ(outlines.size(), 1U);
  const double radius_mm = DrawnTray::kDiscRadiusMm;
  for (const Vec2& point : outlines[0])
    EXPECT_NEAR((point - tray.middle_mm()).norm(), radius_mm, DrawnTray::kCellMm);
  EXPECT_NEAR(area_mm2(outlines[0]), std::numbers::pi * radius_mm * radius_mm, 0.01 * 5027.0);
  EXPECT_LT(outlines[0].size(), 64U);
}

TEST(CellOutlines, AHoleIsWalkedTheOtherWay) {
  DrawnTray tray;
  const int middle = DrawnTray::kCells / 2;
  for (int y = -10; y <= 10; ++y) {
    for (int x = -10; x <= 10; ++x) tray.cell(middle + x, middle + y).label = kDishLabel;
  }
  const std::vector<Outline> outlines = outline_label(tray.heights(), DrawnTray::kFood, 0.0);
  ASSERT_EQ(outlines.size(), 2U);
  const double hole_mm2 = 21.0 * 21.0 * DrawnTray::kCellMm * DrawnTray::kCellMm;
  EXPECT_NEAR(-area_mm2(outlines[1]), hole_mm2, 0.01 * hole_mm2);
}

TEST(CellOutlines, ALabelThatIsNowhereHasNone) {
  const DrawnTray tray;
  EXPECT_TRUE(outline_label(tray.heights(), 7, 0.5).empty());
}

// Each corner of a way through the middles of the sides cuts an eighth of a cell off, or adds it.
TEST(CellOutlines, OfRandomCellsEncloseTheirArea) {
  std::mt19937_64 random(random_seed());
  DrawnTray tray;
  for (int round = 0; round < 20; ++round) {
    int count = 0;
    for (int y = 0; y < DrawnTray::kCells; ++y) {
      for (int x = 0; x < DrawnTray::kCells; ++x) {
        // Blocks of five cells: pieces that touch at corners and at the map's edge, with holes.
        const bool is_food = (x % 5 == 0 && y % 5 == 0) ? random() % 2 == 0
                             : x % 5 != 0               ? tray.cell(x - 1, y).label == DrawnTray::kFood
                                                        : tray.cell(x, y - 1).label == DrawnTray::kFood;
        tray.cell(x, y).label = is_food ? DrawnTray::kFood : kDishLabel;
        count += is_food ? 1 : 0;
      }
    }
    double area = 0.0;
    std::size_t points = 0;
    for (const Outline& outline : outline_label(tray.heights(), DrawnTray::kFood, 0.0)) {
      area += area_mm2(outline);
      points += outline.size();
    }
    const double cell_mm2 = DrawnTray::kCellMm * DrawnTray::kCellMm;
    EXPECT_NEAR(area, count * cell_mm2, 0.125 * cell_mm2 * static_cast<double>(points));
  }
}

}  // namespace
}  // namespace traygauge::test
