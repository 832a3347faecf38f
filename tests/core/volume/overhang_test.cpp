// How much of an item's undercut is seen decides how much of its column is air, and how unsure that is.
#include "core/volume/overhang.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/core/stereo/solid_scene.hpp"

namespace traygauge {
namespace {

constexpr int kFood = 2;
constexpr int kSide = 60;  // cells
constexpr double kCellMm = 1.0;
constexpr double kColumnMl = 120.0;

// An item over a square of 40 cells' side, the first `undercut` of them undercut, seen at a slope of a half.
HeightVolume closed(int undercut, const OverhangParams& params, const LabelSet& round = {}) {
  const InnerSurface dish = test::dinner_plate();
  std::vector<HeightCell> cells(std::size_t{kSide} * kSide);
  HeightMap map;
  map.cells = {cells.data(), kSide, kSide};
  map.cell_mm = kCellMm;
  for (int y = 10; y < 50; ++y) {
    for (int x = 10; x < 50; ++x) {
      HeightCell& cell = map.cells.at(x, y);
      cell.kind = CellKind::surface;
      cell.label = kFood;
      const bool is_outermost = x == 10 || x == 49 || y == 10 || y == 49;
      if (!is_outermost && undercut-- > 0) cell.below_label = 1;
    }
  }
  std::array<SurfaceGrid, 2> views;
  for (SurfaceGrid& view : views) {
    view.camera_mm = Vec3(200.0, 0.0, 400.0 + dish.profile.bottom_height_mm());
    view.camera_mm.head<2>() += dish.place.centre_mm;
  }
  std::vector<HeightVolume> items(256);
  HeightVolume& item = items[kFood];
  item.volume_ml = item.column_volume_ml = kColumnMl;
  item.area_mm2 = 1600.0;
  item.max_height_mm = 40.0;
  close_overhangs(views, map, dish, round, params, items);
  return item;
}

// A ball of this area and height shows 40 · 20 · 0.5 = 400 mm².
TEST(Overhang, TakesAwayMoreTheMoreIsSeenBelow) {
  const OverhangParams params;
  const double air_ml = kColumnMl * (1.0 - 1.0 / params.column_over_closed);
  double before_ml = kColumnMl;
  for (int undercut = 0; undercut <= 400; undercut += 10) {
    const HeightVolume item = closed(undercut, params);
    const double taken = (kColumnMl - item.volume_ml) / air_ml;
    const double share = std::clamp((undercut / 400.0 - params.wall_undercut_fraction) /
                                        (params.fruit_undercut_fraction - params.wall_undercut_fraction),
                                    0.0, 1.0);
    EXPECT_NEAR(taken, share, 1e-9) << undercut;
    EXPECT_LE(item.volume_ml, before_ml);
    EXPECT_NEAR(item.closing_sigma_ml, air_ml * std::sqrt(share * (1.0 - share)), 1e-9);
    EXPECT_EQ(item.undercut_mm2, undercut);
    before_ml = item.volume_ml;
  }
  EXPECT_DOUBLE_EQ(before_ml, kColumnMl / params.column_over_closed);
}

TEST(Overhang, OfRoundBodiesIsSure) {
  LabelSet round;
  round.add(kFood);
  const HeightVolume item = closed(0, {}, round);
  EXPECT_DOUBLE_EQ(item.volume_ml, kColumnMl / OverhangParams{}.column_over_closed);
  EXPECT_EQ(item.closing_sigma_ml, 0.0);
}

TEST(Overhang, IsNotMadeByAFewSamples) {
  OverhangParams params;
  params.wall_undercut_fraction = 0.0;
  params.fruit_undercut_fraction = 0.01;
  EXPECT_EQ(closed(static_cast<int>(params.min_undercut_mm2), params).volume_ml, kColumnMl);
  EXPECT_LT(closed(static_cast<int>(params.min_undercut_mm2) + 1, params).volume_ml, kColumnMl);
}

}  // namespace
}  // namespace traygauge
