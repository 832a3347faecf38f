// Two views become one height map: known bodies, and how views that differ are weighed against each other.
#include "core/volume/height_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "tests/core/stereo/solid_scene.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

constexpr int kMapItem = 6;

InnerSurface round_tile(double radius_mm, double bottom_mm) {
  DishModel model;
  model.outer_size_mm = {2.0 * radius_mm, 2.0 * radius_mm};
  model.rim_height_mm = model.bottom_height_mm = bottom_mm;
  model.profile_points[0].height_mm = bottom_mm;  // level from its edge on
  model.profile_points[1] = {1.0, bottom_mm};
  model.profile_size = 2;
  InnerSurface tile;
  EXPECT_TRUE(tile.profile.set(model).ok());
  return tile;
}

double item_ml(const HeightMap& map, double bottom_mm) {
  double mm3 = 0.0;
  for (int y = 0; y < map.cells.height; ++y) {
    for (int x = 0; x < map.cells.width; ++x) {
      const HeightCell& cell = map.cells.at(x, y);
      if (cell.label == kMapItem)
        mm3 += (static_cast<double>(cell.z_mm) - bottom_mm) * map.cell_mm * map.cell_mm;
    }
  }
  return mm3 / 1000.0;
}

std::array<test::TrueGrid, 2> views_from_both_sides(const test::SolidScene& scene) {
  return {test::cast_grid(scene, {.tilt_deg = 20.0, .azimuth_deg = 0.0}, {}, 60'000.0),
          test::cast_grid(scene, {.tilt_deg = 20.0, .azimuth_deg = 180.0}, {}, 60'000.0)};
}

TEST(HeightMap, HoldsTheVolumesOfConeCapAndBox) {
  constexpr double kBottomMm = 3.0;
  std::vector<HeightCell> cells(std::size_t{300 * 300});
  test::Allocated<HeightMapWorkspace> space(std::size_t{300 * 300}, std::size_t{1024});
  test::SolidScene scene;
  scene.dish = round_tile(90.0, kBottomMm);
  scene.dish.place.centre_mm = Vec2(35.0, -12.0);
  const Vec2& centre = scene.dish.place.centre_mm;
  const auto expect_ml = [&](const test::Solid& solid, double truth_ml) {
    scene.solids = {solid};
    const std::array<test::TrueGrid, 2> grids = views_from_both_sides(scene);
    const std::array<SurfaceGrid, 2> views = {grids[0].view(), grids[1].view()};
    HeightMap map;
    ASSERT_TRUE(build_height_map(views, scene.dish, {}, cells, *space, map).ok());
    EXPECT_NEAR(item_ml(map, kBottomMm), truth_ml, 0.015 * truth_ml) << solid.name;
    const std::array<SurfaceGrid, 2> swapped = {views[1], views[0]};
    HeightMap turned;
    ASSERT_TRUE(build_height_map(swapped, scene.dish, {}, cells, *space, turned).ok());
    EXPECT_NEAR(item_ml(turned, kBottomMm), truth_ml, 0.015 * truth_ml) << solid.name;
  };
  expect_ml(test::cone(kMapItem, centre, 40.0, kBottomMm, 30.0),
            std::numbers::pi * 40.0 * 40.0 * 30.0 / 3.0 / 1000.0);
  expect_ml(test::cap(kMapItem, centre, 40.0, kBottomMm, 25.0),
            std::numbers::pi * 25.0 * (3.0 * 40.0 * 40.0 + 25.0 * 25.0) / 6.0 / 1000.0);
  expect_ml(test::box(kMapItem, centre, Vec2(25.0, 20.0), 0.0, kBottomMm + 28.0),
            50.0 * 40.0 * 28.0 / 1000.0);
}

// A level at `z_mm`, seen from a camera `tilt` off the vertical.
test::TrueGrid level_grid(double z_mm, const Vec3& camera_mm) {
  test::TrueGrid grid(60, 60);
  grid.camera_mm = camera_mm;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const std::size_t k = grid.index(x, y);
      grid.points[k] = {static_cast<float>(x - 30), static_cast<float>(y - 30), static_cast<float>(z_mm)};
      grid.evidence[k] = SurfaceEvidence::both;
      grid.labels[k] = kMapItem;
    }
  }
  return grid;
}

float middle_mm(const test::TrueGrid& a, const test::TrueGrid& b, double disagreement_mm) {
  std::vector<HeightCell> cells(std::size_t{100 * 100});
  test::Allocated<HeightMapWorkspace> space(std::size_t{100 * 100}, std::size_t{64});
  HeightMapParams params;
  params.disagreement_mm = disagreement_mm;
  HeightMap map;
  const std::array<SurfaceGrid, 2> views = {a.view(), b.view()};
  EXPECT_TRUE(build_height_map(views, round_tile(20.0, 0.0), params, cells, *space, map).ok());
  return map.cells.at(map.cells.width / 2, map.cells.height / 2).z_mm;
}

TEST(HeightMap, TakesTheMeanOfViewsThatAgreeAndTheBetterSeenElse) {
  const Vec3 above(0.0, 0.0, 400.0);
  const Vec3 aside(350.0, 0.0, 200.0);
  EXPECT_NEAR(middle_mm(level_grid(10.0, above), level_grid(12.0, above), 3.0), 11.0, 0.01);
  const float nearer_better = middle_mm(level_grid(10.0, above), level_grid(12.0, aside), 3.0);
  EXPECT_GT(nearer_better, 10.0F);
  EXPECT_LT(nearer_better, 10.7F);
  EXPECT_NEAR(middle_mm(level_grid(10.0, above), level_grid(15.0, aside), 3.0), 10.0, 1e-3);
  EXPECT_NEAR(middle_mm(level_grid(15.0, aside), level_grid(10.0, above), 3.0), 10.0, 1e-3);
}

TEST(HeightMap, CoversATurnedOvalWhole) {
  DishModel model;
  model.outer_size_mm = {120.0, 60.0};
  InnerSurface oval;
  ASSERT_TRUE(oval.profile.set(model).ok());
  const test::TrueGrid grid = level_grid(10.0, Vec3(0.0, 0.0, 400.0));
  const std::array<SurfaceGrid, 1> views = {grid.view()};
  std::vector<HeightCell> cells(std::size_t{200 * 200});
  test::Allocated<HeightMapWorkspace> space(std::size_t{200 * 200}, std::size_t{64});
  for (const double turn : {0.0, 0.4, 1.2, 2.5}) {
    oval.place = {Vec2(5.0, 7.0), Vec2(std::cos(turn), std::sin(turn))};
    HeightMap map;
    ASSERT_TRUE(build_height_map(views, oval, {}, cells, *space, map).ok());
    double left = 1e9;
    double right = -1e9;
    double top = 1e9;
    double bottom = -1e9;
    for (int i = 0; i < 3600; ++i) {
      const double t = i * std::numbers::pi / 1800.0;
      const Vec2 edge =
          oval.place.centre_mm + turned_by(Vec2(60.0 * std::cos(t), 30.0 * std::sin(t)), oval.place.axis);
      left = std::min(left, edge.x());
      right = std::max(right, edge.x());
      top = std::min(top, edge.y());
      bottom = std::max(bottom, edge.y());
    }
    const Vec2 first = map.origin_mm - Vec2::Constant(0.5 * map.cell_mm);
    const Vec2 last = first + map.cell_mm * Vec2(map.cells.width, map.cells.height);
    EXPECT_LE(first.x(), left + 1e-3);
    EXPECT_LE(first.y(), top + 1e-3);
    EXPECT_GE(last.x(), right - 1e-3);
    EXPECT_GE(last.y(), bottom - 1e-3);
    EXPECT_LT(last.x() - first.x(), right - left + 2.0 * map.cell_mm);
    EXPECT_LT(last.y() - first.y(), bottom - top + 2.0 * map.cell_mm);
  }
}

TEST(HeightMap, RefusesWhatItCannotHold) {
  const test::TrueGrid grid = level_grid(10.0, Vec3(0.0, 0.0, 400.0));
  const std::array<SurfaceGrid, 1> views = {grid.view()};
  InnerSurface tile = round_tile(20.0, 0.0);
  HeightMap map;
  std::vector<HeightCell> cells(std::size_t{40 * 40});
  const auto run = [&](const InnerSurface& dish, HeightMapWorkspace& space, double cell_mm) {
    HeightMapParams params;
    params.cell_mm = cell_mm;
    return build_height_map(views, dish, params, cells, space, map).code();
  };
  test::Allocated<HeightMapWorkspace> space(std::size_t{40 * 40}, std::size_t{60});
  test::Allocated<HeightMapWorkspace> few_cells(std::size_t{40 * 40 - 1}, std::size_t{60});
  test::Allocated<HeightMapWorkspace> narrow(std::size_t{40 * 40}, std::size_t{59});
  EXPECT_EQ(run(tile, *space, 1.0), StatusCode::ok);
  EXPECT_EQ(run(tile, *few_cells, 1.0), StatusCode::out_of_memory);
  EXPECT_EQ(run(tile, *narrow, 1.0), StatusCode::out_of_memory);
  const auto short_of_one = std::span(cells).first(cells.size() - 1);
  EXPECT_EQ(build_height_map(views, tile, {.cell_mm = 1.0}, short_of_one, *space, map).code(),
            StatusCode::out_of_memory);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double cell_mm : {0.0, -1.0, kNan})
    EXPECT_EQ(run(tile, *space, cell_mm), StatusCode::invalid_configuration) << cell_mm;
  EXPECT_EQ(run(tile, *space, 1e-6), StatusCode::out_of_memory);
  EXPECT_EQ(build_height_map({}, tile, {.cell_mm = 1.0}, cells, *space, map).code(),
            StatusCode::too_little_depth);
  const std::array<SurfaceGrid, 2> empty{};
  EXPECT_EQ(build_height_map(empty, tile, {.cell_mm = 1.0}, cells, *space, map).code(),
            StatusCode::too_little_depth);
  tile.place.centre_mm.x() = kNan;
  EXPECT_EQ(run(tile, *space, 1.0), StatusCode::wrong_call);
}

}  // namespace
}  // namespace traygauge
