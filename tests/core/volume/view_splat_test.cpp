// What one view sees in a height map: planes, and what a box hides, against ray casting and straight lines.
#include "core/volume/view_splat.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/core/stereo/solid_scene.hpp"

namespace traygauge {
namespace {

constexpr double kSplatCellMm = 1.0;
constexpr std::uint8_t kSplatItem = 5;

InnerSurface flat_tile(double half_mm, double bottom_mm) {
  DishModel model;
  model.outer_size_mm = {2.0 * half_mm, 2.0 * half_mm};
  model.rim_height_mm = model.bottom_height_mm = bottom_mm;
  model.profile_points[0].height_mm = bottom_mm;  // level from its edge on
  model.profile_points[1] = {1.0, bottom_mm};
  model.profile_size = 2;
  InnerSurface tile;
  EXPECT_TRUE(tile.profile.set(model).ok());
  return tile;
}

struct Splat {
  std::vector<HeightCell> storage;
  std::vector<HeightMapWorkspace::Corner> corners;
  HeightMap map;

  explicit Splat(int side)
      : storage(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), HeightCell{.z_mm = 77.0F}) {
    map.cells = {storage.data(), side, side};
    map.cell_mm = kSplatCellMm;
    map.origin_mm = Vec2::Constant(-0.5 * kSplatCellMm * (side - 1));
  }
  void run(const test::TrueGrid& grid, const HeightMapParams& params = {}) {
    corners.resize(HeightMapWorkspace::kCornerRows * static_cast<std::size_t>(grid.width));
    splat_view(grid.view(), params, corners, map);
  }
  const HeightCell& at(double x_mm, double y_mm) const {
    return map.cells.at(static_cast<int>(std::lround((x_mm - map.origin_mm.x()) / kSplatCellMm)),
                        static_cast<int>(std::lround((y_mm - map.origin_mm.y()) / kSplatCellMm)));
  }
};

// Samples of z = 10 + x / 4 − y / 5, 0.7 mm apart in x and 0.9 mm in y.
test::TrueGrid sloping_grid(int side) {
  test::TrueGrid grid(side, side);
  grid.camera_mm = Vec3(-150.0, 80.0, 450.0);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Vec2 at(0.7 * (x - side / 2), 0.9 * (y - side / 2));
      const std::size_t k = grid.index(x, y);
      grid.points[k] = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                        static_cast<float>(10.0 + at.x() / 4.0 - at.y() / 5.0)};
      grid.evidence[k] = SurfaceEvidence::single;
      grid.labels[k] = at.x() < 0.0 ? std::uint8_t{1} : kSplatItem;
    }
  }
  return grid;
}

TEST(ViewSplat, PutsAPlaneWhereItIs) {
  const test::TrueGrid grid = sloping_grid(61);
  Splat splat(81);
  splat.run(grid);
  int seen = 0;
  for (int y = 0; y < splat.map.cells.height; ++y) {
    for (int x = 0; x < splat.map.cells.width; ++x) {
      const HeightCell& cell = splat.map.cells.at(x, y);
      const Vec2 at = splat.map.centre_mm(x, y);
      const bool covered = std::abs(at.x()) <= 21.0 && std::abs(at.y()) <= 27.0;
      ASSERT_EQ(cell.kind, covered ? CellKind::surface : CellKind::unseen) << at.transpose();
      if (!covered) continue;
      ++seen;
      EXPECT_NEAR(cell.z_mm, 10.0 + at.x() / 4.0 - at.y() / 5.0, 1e-3);
      if (std::abs(at.x() + 0.35) > 0.36) {
        EXPECT_EQ(cell.label, at.x() < 0.0 ? 1 : kSplatItem);
      }
      const Vec3 sight = Vec3(at.x(), at.y(), cell.z_mm) - grid.camera_mm;
      const Vec3 normal = Vec3(-0.25, 0.2, 1.0).normalized();
      const double cosine = normal.dot(sight) / sight.norm();
      EXPECT_NEAR(cell.weight / 255.0, cosine * cosine, 0.02);
    }
  }
  EXPECT_EQ(seen, 43 * 55);
}

TEST(ViewSplat, LeavesOutWhatIsNotKnown) {
  test::TrueGrid grid = sloping_grid(61);
  const auto at = [&](int x, int y) { return grid.index(x, y); };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (int y = 10; y < 20; ++y) {
    for (int x = 10; x < 20; ++x) grid.evidence[at(x, y)] = SurfaceEvidence::none;
    for (int x = 30; x < 40; ++x) grid.points[at(x, y)].z_mm = kNan;
    for (int x = 45; x < 55; ++x) grid.labels[at(x, y)] = kCardLabel;
  }
  Splat splat(81);
  splat.run(grid);
  for (const double x : {-10.5, 3.5, 14.0}) {
    EXPECT_EQ(splat.at(x, 0.9 * (14.5 - 30.0)).kind, CellKind::unseen) << x;
    EXPECT_EQ(splat.at(x, 0.9 * (30.5 - 30.0)).kind, CellKind::surface) << x;
  }
  int sane = 0;
  for (const HeightCell& cell : splat.storage) sane += std::isfinite(cell.z_mm) ? 1 : 0;
  EXPECT_EQ(sane, 81 * 81);
}

TEST(ViewSplat, SkipsViewsWithoutAQuad) {
  Splat splat(21);
  splat.run(sloping_grid(1));
  for (const HeightCell& cell : splat.storage) {
    ASSERT_EQ(cell.kind, CellKind::unseen);
    ASSERT_EQ(cell.z_mm, 0.0F);  // what was there before is gone
  }
}

// Behind a box the lines of sight over its edge bound what may be there: straight lines from the camera.
TEST(ViewSplat, BoundsWhatABoxHidesByTheLinesOverItsEdge) {
  constexpr double kHalfMm = 20.0;
  constexpr double kTopMm = 34.0;
  constexpr double kBottomMm = 4.0;
  test::SolidScene scene;
  scene.dish = flat_tile(80.0, kBottomMm);
  scene.solids = {test::box(kSplatItem, Vec2::Zero(), Vec2(kHalfMm, kHalfMm), 0.0, kTopMm)};
  const test::TrueGrid grid =
      test::cast_grid(scene, {.distance_mm = 450.0, .tilt_deg = 30.0, .azimuth_deg = 180.0}, {}, 40'000.0);
  Splat splat(121);
  splat.run(grid);
  const Vec3& eye = grid.camera_mm;
  const double slope = (eye.z() - kTopMm) / (kHalfMm - eye.x());
  const double end_mm = kHalfMm + (kTopMm - kBottomMm) / slope;
  ASSERT_GT(end_mm, 35.0);
  for (double x = kHalfMm + 2.0; x < end_mm - 2.0; x += 1.0) {
    for (const double y : {-12.0, 0.0, 9.0}) {
      const HeightCell& cell = splat.at(x, y);
      ASSERT_EQ(cell.kind, CellKind::hidden) << x << " " << y;
      // Across the view the run is a little longer than in its middle.
      const double run = std::hypot(x - kHalfMm, y * (x - kHalfMm) / (kHalfMm - eye.x()));
      EXPECT_NEAR(cell.z_mm, kTopMm - slope * run, 2.0) << x << " " << y;
      EXPECT_EQ(cell.label, kSplatItem);
      EXPECT_EQ(cell.below_label, kDishLabel);
      EXPECT_NEAR(cell.below_mm, kBottomMm, 0.1);
    }
  }
  for (const double x : {-30.0, -18.0, 0.0, 18.0, end_mm + 3.0}) {
    const HeightCell& cell = splat.at(x, 0.0);
    ASSERT_EQ(cell.kind, CellKind::surface) << x;
    EXPECT_NEAR(cell.z_mm, std::abs(x) < kHalfMm ? kTopMm : kBottomMm, 0.05);
  }
}

// A shelf over the dish: its upper side stays, and cells remember that a view sees well below it.
TEST(ViewSplat, KeepsTheUppermostAndRemembersWhatIsBelow) {
  test::TrueGrid grid(40, 81);
  grid.camera_mm = Vec3(0.0, -60.0, 600.0);
  const auto lay = [&](int from, double z_mm, std::uint8_t label) {
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        const std::size_t k = grid.index(x, from + y);
        grid.points[k] = {static_cast<float>(x - 20), static_cast<float>(y - 20), static_cast<float>(z_mm)};
        grid.evidence[k] = SurfaceEvidence::both;
        grid.labels[k] = label;
      }
    }
  };
  for (const double shelf_mm : {30.0, 3.0}) {
    for (const bool is_shelf_first : {true, false}) {
      lay(is_shelf_first ? 0 : 41, shelf_mm, kSplatItem);  // a row without points between
      lay(is_shelf_first ? 41 : 0, 0.0, kDishLabel);
      Splat splat(21);
      splat.run(grid, {.undercut_mm = 4.0});
      const HeightCell& cell = splat.at(0.0, 0.0);
      EXPECT_EQ(cell.kind, CellKind::surface);
      EXPECT_EQ(cell.label, kSplatItem);
      EXPECT_NEAR(cell.z_mm, shelf_mm, 1e-3);
      EXPECT_EQ(cell.below_label, shelf_mm > 4.0 ? kDishLabel : 0) << shelf_mm << is_shelf_first;
    }
  }
}

}  // namespace
}  // namespace traygauge
