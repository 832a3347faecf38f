// Solids of exactly known volume, ray cast from two cameras: hidden flanks, edges, overhangs, liquids.
#include "core/volume/height_volume.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/core/stereo/solid_scene.hpp"
#include "tests/core/volume/height_measurement.hpp"

namespace traygauge {
namespace {

using test::HeightMeasurement;
using test::SceneCamera;
using test::SceneNoise;
using test::Solid;
using test::SolidScene;
using test::TrueGrid;

constexpr double kBottomMm = 4.5;  // of the dinner plate

struct CameraPairOfScene {
  SceneCamera first;
  SceneCamera second;
};

const std::vector<CameraPairOfScene>& camera_pairs() {
  static const std::vector<CameraPairOfScene> pairs = {
      {{450, 5, 0}, {450, 20, 20}}, {{560, 20, 100}, {500, 20, 150}}, {{420, 33, 200}, {450, 20, 222}}};
  return pairs;
}

// Two views of a scene, measured.
class SceneMeasurement {
 public:
  SceneMeasurement(const SolidScene& scene, const CameraPairOfScene& cameras, SceneNoise noise = {})
      : scene_(scene), grids_{cast(cameras.first, noise), TrueGrid()} {
    ++noise.seed;
    grids_[1] = cast(cameras.second, noise);
    views_ = {grids_[0].view(), grids_[1].view()};
    status_ = measurement_.run(views_, scene_.dish);
  }

  Status status() const { return status_; }
  const HeightVolume& item(int label) { return measurement_.item(label); }
  HeightMeasurement& measurement() { return measurement_; }
  double column_error(int label) { return item(label).column_volume_ml / scene_.column_ml(label) - 1.0; }
  double closed_error(int label) { return item(label).volume_ml / scene_.closed_ml(label) - 1.0; }

 private:
  // Half of the usual samples, to spend less time on casting.
  TrueGrid cast(const SceneCamera& camera, const SceneNoise& noise) const {
    return test::cast_grid(scene_, camera, noise, 0.5 * test::kWorkingDishPixels);
  }

  SolidScene scene_;
  std::array<TrueGrid, 2> grids_;
  std::array<SurfaceGrid, 2> views_;
  HeightMeasurement measurement_;
  Status status_;
};

SolidScene plate_of_fields() {
  SolidScene scene;
  scene.dish = test::dinner_plate();
  const Vec2& c = scene.dish.place.centre_mm;
  scene.solids = {test::cone(2, c + Vec2(-40, 30), 32, kBottomMm, 40),
                  test::cap(3, c + Vec2(40, 32), 35, kBottomMm, 25),
                  test::box(4, c + Vec2(-35, -40), {30, 22}, 0.4, 30),
                  test::heap(5, c + Vec2(42, -38), {32, 40}, kBottomMm, 24, 4, 9, 2)};
  return scene;
}

SolidScene plate_of_fruit() {
  SolidScene scene;
  scene.dish = test::dinner_plate();
  const Vec2& c = scene.dish.place.centre_mm;
  const auto on_plate = [&](double x, double y, double z) {
    return Vec3(c.x() + x, c.y() + y, kBottomMm + z);
  };
  scene.solids = {test::ellipsoid(2, on_plate(-45, 30, 25), {25, 25, 25}, 0.0),
                  test::ellipsoid(3, on_plate(40, 20, 22), {45, 24, 22}, 0.7),
                  test::ellipsoid(4, on_plate(-5, -45, 20), {27, 27, 20}, 0.0)};
  return scene;
}

TEST(HeightVolume, OfHeightFieldsFromTwoPerfectViews) {
  const SolidScene scene = plate_of_fields();
  double sum = 0.0;
  double magnitude = 0.0;
  double count = 0.0;
  for (const CameraPairOfScene& cameras : camera_pairs()) {
    SceneMeasurement measured(scene, cameras);
    ASSERT_TRUE(measured.status().ok());
    for (const Solid& solid : scene.solids) {
      const double error = measured.column_error(solid.label);
      std::printf("%-5s %+.2f%%  hidden %.1f%%\n", solid.name.c_str(), 100 * error,
                  100 * measured.item(solid.label).hidden_fraction);
      EXPECT_LT(std::abs(error), 0.02) << solid.name;
      EXPECT_NEAR(measured.item(solid.label).volume_ml, measured.item(solid.label).column_volume_ml,
                  0.005 * measured.item(solid.label).column_volume_ml)
          << solid.name << " does not overhang";
      sum += error;
      magnitude += std::abs(error);
      count += 1.0;
    }
  }
  EXPECT_LT(magnitude / count, 0.01);
  EXPECT_LT(std::abs(sum / count), 0.004);
}

// Of a cone's slope at a third of its height, of a box's lid in the middle.
TEST(HeightVolume, KnowsTheCentresOfItems) {
  const SolidScene scene = plate_of_fields();
  const Vec2& c = scene.dish.place.centre_mm;
  const Vec3 cone(c.x() - 40.0, c.y() + 30.0, kBottomMm + 40.0 / 3.0);
  const Vec3 box(c.x() - 35.0, c.y() - 40.0, 30.0);
  for (const CameraPairOfScene& cameras : camera_pairs()) {
    SceneMeasurement measured(scene, cameras);
    ASSERT_TRUE(measured.status().ok());
    std::printf("%.2f %.2f\n", (measured.item(2).centre_mm - cone).norm(),
                (measured.item(4).centre_mm - box).norm());
    EXPECT_LT((measured.item(2).centre_mm - cone).norm(), 0.5);
    EXPECT_LT((measured.item(4).centre_mm - box).norm(), 0.5);
  }
}

// Two blocks of one item: 18 mm of wall between them over 40 mm. What bounds an item is no wall of its own,
// nor is a slope. The walls that fill what is hidden behind a block count as well.
TEST(HeightVolume, MeasuresWallsWithinItems) {
  SolidScene scene;
  scene.dish = test::dinner_plate();
  const Vec2& c = scene.dish.place.centre_mm;
  scene.solids = {test::box(2, c + Vec2(-55, 0), {15, 20}, 0.0, 34),
                  test::box(2, c + Vec2(-25, 0), {15, 20}, 0.0, 16),
                  test::cone(3, c + Vec2(40, 30), 32, kBottomMm, 30)};
  for (const CameraPairOfScene& cameras : camera_pairs()) {
    SceneMeasurement measured(scene, cameras);
    ASSERT_TRUE(measured.status().ok());
    std::printf("wall %.0f mm2, of the cone %.0f\n", measured.item(2).wall_mm2, measured.item(3).wall_mm2);
    EXPECT_GT(measured.item(2).wall_mm2, 0.9 * 18.0 * 40.0);
    EXPECT_LT(measured.item(3).wall_mm2, 60.0);
  }
}

TEST(HeightVolume, SurvivesDepthAndLabelNoise) {
  const SolidScene scene = plate_of_fields();
  SceneNoise noise;
  noise.depth_mm = 0.5;
  noise.label_px = 0.5;
  noise.correlation_px = 8;
  noise.seed = 5;
  SceneMeasurement measured(scene, camera_pairs()[1], noise);
  ASSERT_TRUE(measured.status().ok());
  for (const Solid& solid : scene.solids) {
    EXPECT_LT(std::abs(measured.column_error(solid.label)), 0.03) << solid.name;
    EXPECT_NEAR(measured.item(solid.label).volume_ml, measured.item(solid.label).column_volume_ml, 1e-9);
  }
}

TEST(HeightVolume, OfRoundFruit) {
  const SolidScene scene = plate_of_fruit();
  double column = 0.0;
  double closed = 0.0;
  double count = 0.0;
  for (const CameraPairOfScene& cameras : camera_pairs()) {
    SceneMeasurement measured(scene, cameras);
    ASSERT_TRUE(measured.status().ok());
    for (const Solid& solid : scene.solids) {
      std::printf("fruit column %+.2f%% closed %+.2f%%\n", 100 * measured.column_error(solid.label),
                  100 * measured.closed_error(solid.label));
      EXPECT_LT(std::abs(measured.column_error(solid.label)), 0.045);
      EXPECT_LT(std::abs(measured.closed_error(solid.label)), 0.07);
      column += std::abs(measured.column_error(solid.label));
      closed += std::abs(measured.closed_error(solid.label));
      count += 1.0;
    }
  }
  EXPECT_LT(column / count, 0.02);
  EXPECT_LT(closed / count, 0.05);
}

TEST(HeightVolume, OfHalvedFruitIsItsColumn) {
  SolidScene scene;
  scene.dish = test::dinner_plate();
  const Vec2& c = scene.dish.place.centre_mm;
  scene.solids = {test::ellipsoid(2, {c.x() - 30, c.y(), kBottomMm}, {30, 30, 30}, 0.0),
                  test::cap(3, c + Vec2(45, 10), 30, kBottomMm, 20)};
  SceneMeasurement measured(scene, camera_pairs()[0]);
  ASSERT_TRUE(measured.status().ok());
  for (const int label : {2, 3}) {
    EXPECT_DOUBLE_EQ(measured.item(label).volume_ml, measured.item(label).column_volume_ml);
    EXPECT_LT(std::abs(measured.column_error(label)), 0.02);
  }
}

TEST(HeightVolume, LevelsALiquidWithSolidsInIt) {
  SolidScene scene;
  scene.dish = test::soup_bowl();
  const Vec2& c = scene.dish.place.centre_mm;
  scene.solids = {test::liquid(2, scene.dish, 30), test::cap(2, c + Vec2(15, 10), 15, 28, 12)};
  SceneNoise noise;
  noise.depth_mm = 0.5;
  noise.label_px = 0.5;
  noise.correlation_px = 8;
  noise.seed = 3;
  for (const CameraPairOfScene& cameras : camera_pairs()) {
    SceneMeasurement measured(scene, cameras, noise);
    ASSERT_TRUE(measured.status().ok());
    EXPECT_EQ(measured.measurement().liquid.label, 2);
    EXPECT_NEAR(measured.measurement().liquid.level_mm, 30.0, 0.15);
    EXPECT_LT(std::abs(measured.column_error(2)), 0.01);
  }
}

TEST(HeightVolume, LeavesAHeapInABowlAsItIs) {
  SolidScene scene;
  scene.dish = test::soup_bowl();
  scene.solids = {test::heap(2, scene.dish.place.centre_mm, {60, 60}, 5, 36, 4, 14, 7)};
  SceneMeasurement measured(scene, camera_pairs()[0]);
  ASSERT_TRUE(measured.status().ok());
  EXPECT_EQ(measured.measurement().liquid.label, 0);
  EXPECT_LT(std::abs(measured.column_error(2)), 0.01);
}

TEST(HeightVolume, ASecondViewSeesWhatTheFirstCannot) {
  SolidScene scene;
  scene.dish = test::dinner_plate();
  scene.solids = {test::cone(2, scene.dish.place.centre_mm, 32, kBottomMm, 60)};
  const SceneCamera from_left{500, 33, 180};
  const SceneCamera from_right{500, 33, 0};
  SceneMeasurement same(scene, {from_left, from_left});
  SceneMeasurement both(scene, {from_left, from_right});
  EXPECT_GT(same.item(2).hidden_fraction, 0.05);
  EXPECT_LT(both.item(2).hidden_fraction, 0.02);
  EXPECT_LT(std::abs(both.column_error(2)), 0.005);
}

TEST(HeightVolume, FitsItsMemoryAndRefusesMore) {
  HeightMeasurement measurement;
  EXPECT_LE(
      measurement.map_space.bytes() + measurement.volume_space.bytes() + measurement.liquid_space.bytes(),
      std::size_t{4} << 20);
  const SolidScene scene = plate_of_fields();
  const TrueGrid grid = test::cast_grid(scene, {}, {}, 4096);
  const SurfaceGrid view = grid.view();
  HeightMapParams params;
  params.cell_mm = 0.6;
  EXPECT_EQ(measurement.run({&view, 1}, scene.dish, params).code(), StatusCode::out_of_memory);
  params.cell_mm = 0.0;
  EXPECT_EQ(measurement.run({&view, 1}, scene.dish, params).code(), StatusCode::invalid_configuration);
  TrueGrid wide(1025, 4);
  const SurfaceGrid wide_view = wide.view();
  EXPECT_EQ(measurement.run({&wide_view, 1}, scene.dish).code(), StatusCode::out_of_memory);
}

TEST(HeightVolume, BadGridsGiveAStatus) {
  HeightMeasurement measurement;
  const SolidScene scene = plate_of_fields();
  EXPECT_EQ(measurement.run({}, scene.dish).code(), StatusCode::too_little_depth);
  TrueGrid grid(64, 64);
  const SurfaceGrid empty = grid.view();
  EXPECT_EQ(measurement.run({&empty, 1}, scene.dish).code(), StatusCode::no_food_label);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float huge = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < grid.count(); ++k) {
    grid.evidence[k] = SurfaceEvidence::single;
    grid.labels[k] = static_cast<std::uint8_t>(k % 251);
    grid.points[k] = k % 3 == 0 ? SurfacePoint{nan, 0.0F, 0.0F} : SurfacePoint{huge, -huge, huge};
  }
  const SurfaceGrid bad = grid.view();
  (void)measurement.run({&bad, 1}, scene.dish).ok();
  for (int label = 0; label < 256; ++label) EXPECT_TRUE(std::isfinite(measurement.item(label).volume_ml));
}

}  // namespace
}  // namespace traygauge
