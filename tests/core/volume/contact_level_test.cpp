// How high liquids stand by their outline on the wall, in ray-cast scenes whose heights are known.
#include "core/volume/contact_level.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "core/stereo/dish_projection.hpp"
#include "core/volume/level_liquid.hpp"
#include "tests/core/stereo/solid_scene.hpp"
#include "tests/core/volume/height_measurement.hpp"

namespace traygauge {
namespace {

using test::HeightMeasurement;
using test::SceneCamera;
using test::SceneNoise;
using test::SolidScene;
using test::TrueGrid;

constexpr double kToleranceMm = 1.0;
constexpr double kLevelMm = 30.0;
using CameraPair = std::array<SceneCamera, 2>;
constexpr CameraPair kFromAbove = {{{450, 5, 0}, {450, 20, 20}}};
constexpr CameraPair kAslant = {{{420, 33, 200}, {450, 20, 222}}};

// Two views of a scene, the dish's samples on its surface.
class TwoViews {
 public:
  TwoViews(const SolidScene& scene, const CameraPair& cameras, SceneNoise noise = {}) : scene_(scene) {
    for (std::size_t v = 0; v < 2; ++v, ++noise.seed) {
      grids_[v] = test::cast_grid(scene, cameras[v], noise, 0.5 * test::kWorkingDishPixels);
      const TrueGrid cast = grids_[v];
      project_onto_dish(scene.dish, cast.view(), grids_[v].points, grids_[v].evidence);
    }
  }

  std::array<SurfaceGrid, 2> views() const { return {grids_[0].view(), grids_[1].view()}; }
  ContactLevel contact(std::uint8_t label) const {
    std::array<std::uint32_t, LevelLiquidWorkspace::kBins> histogram{};
    return find_contact_level(views(), scene_.dish, label, kToleranceMm, histogram);
  }

 private:
  SolidScene scene_;
  std::array<TrueGrid, 2> grids_;
};

SolidScene soup() {
  SolidScene scene;
  scene.dish = test::soup_bowl();
  scene.solids = {test::liquid(2, scene.dish, kLevelMm)};
  return scene;
}

InnerSurface cone() {
  DishModel model;
  model.outer_size_mm = {200.0, 200.0};
  model.profile_points[0] = {0.0, 40.0};
  model.profile_points[1] = {80.0, 0.0};
  model.profile_size = 2;
  InnerSurface dish;
  EXPECT_TRUE(dish.profile.set(model).ok());
  return dish;
}

// Rows of one sample of item 2 and one of the dish on either side of the radius where a cone has these
// heights, seen from straight above.
TrueGrid rows_at(const std::vector<double>& heights_mm) {
  TrueGrid grid(2, static_cast<int>(heights_mm.size()));
  grid.camera_mm = {0.0, 0.0, 500.0};
  for (int y = 0; y < grid.height; ++y) {
    const double height_mm = heights_mm[static_cast<std::size_t>(y)];
    const double radius_mm = 20.0 + 2.0 * height_mm;
    for (int x = 0; x < 2; ++x) {
      const double scale = x == 0 ? 0.99 : 1.01;
      grid.points[grid.index(x, y)] = {static_cast<float>(scale * radius_mm), 0.0F,
                                       static_cast<float>(height_mm)};
      grid.labels[grid.index(x, y)] = x == 0 ? 2 : kDishLabel;
    }
  }
  return grid;
}

TEST(ContactLevel, IsWhereMostOfTheOutlineLies) {
  const TrueGrid grid = rows_at({12.0, 12.2, 30.0, 11.8, 5.0, 12.1, 11.9, 38.0, 12.0});
  const SurfaceGrid view = grid.view();
  std::array<std::uint32_t, LevelLiquidWorkspace::kBins> histogram{};
  const ContactLevel level = find_contact_level({&view, 1}, cone(), 2, kToleranceMm, histogram);
  EXPECT_EQ(level.samples, 9);
  EXPECT_DOUBLE_EQ(level.share, 6.0 / 9.0);
  EXPECT_NEAR(level.level_mm, 12.0, 0.5 * kContactBinMm);
}

TEST(ContactLevel, OfAnItemThatTouchesNoDishHasNoShare) {
  const TrueGrid grid = rows_at({12.0, 12.0});
  const SurfaceGrid view = grid.view();
  std::array<std::uint32_t, LevelLiquidWorkspace::kBins> histogram{};
  const ContactLevel level = find_contact_level({&view, 1}, cone(), 3, kToleranceMm, histogram);
  EXPECT_EQ(level.samples, 0);
  EXPECT_EQ(level.share, 0.0);
}

TEST(ContactLevel, OfALiquidSeenFromAboveIsItsWholeOutline) {
  const ContactLevel level = TwoViews(soup(), {{{450, 0, 0}, {500, 0, 0}}}).contact(2);
  std::printf("%.3f mm, %.3f of %d\n", level.level_mm, level.share, level.samples);
  EXPECT_NEAR(level.level_mm, kLevelMm, 0.1);
  EXPECT_GT(level.share, 0.99);
  EXPECT_GT(level.samples, 1000);
}

// The near wall hides a part of it; what is seen past the wall is the dish's crest.
TEST(ContactLevel, OfALiquidSeenAslantIsTheFarWalls) {
  const ContactLevel above = TwoViews(soup(), kFromAbove).contact(2);
  const ContactLevel aslant = TwoViews(soup(), kAslant).contact(2);
  std::printf("%.3f mm, %.3f; %.3f mm, %.3f\n", above.level_mm, above.share, aslant.level_mm, aslant.share);
  EXPECT_NEAR(above.level_mm, kLevelMm, 0.1);
  EXPECT_NEAR(aslant.level_mm, kLevelMm, 0.1);
  EXPECT_LT(aslant.share, above.share - 0.1);
  EXPECT_GE(aslant.share, LevelLiquidParams{}.min_contact_fraction);
}

TEST(ContactLevel, NeedsNoMatchedHeights) {
  SceneNoise noise;
  noise.depth_mm = 10.0;
  const ContactLevel exact = TwoViews(soup(), kAslant).contact(2);
  const ContactLevel noisy = TwoViews(soup(), kAslant, noise).contact(2);
  EXPECT_NEAR(noisy.level_mm, exact.level_mm, 0.01);
  EXPECT_EQ(noisy.samples, exact.samples);
  EXPECT_NEAR(noisy.share, exact.share, 0.002);
}

// The noise that stands highest counts as solids, so that volumes come out too large.
struct NoisySoup {
  int correlation_px = 1;
  double max_volume_error = 0.0;
};
class LevelLiquidInBowl : public ::testing::TestWithParam<NoisySoup> {};
INSTANTIATE_TEST_SUITE_P(Correlated, LevelLiquidInBowl,
                         ::testing::Values(NoisySoup{1, 0.03}, NoisySoup{4, 0.015}, NoisySoup{8, 0.015},
                                           NoisySoup{20, 0.02}));

// Heights of glossy soups: nothing was matched right.
TEST_P(LevelLiquidInBowl, IsFoundThroughStrongNoise) {
  const SolidScene scene = soup();
  SceneNoise noise;
  noise.depth_mm = 3.0;
  noise.correlation_px = GetParam().correlation_px;
  noise.seed = 17;
  std::printf("seed %u\n", noise.seed);
  for (const CameraPair& cameras : {kFromAbove, kAslant}) {
    const TwoViews seen(scene, cameras, noise);
    HeightMeasurement measurement;
    ASSERT_TRUE(measurement.run(seen.views(), scene.dish).ok());
    const double error = measurement.item(2).column_volume_ml / scene.column_ml(2) - 1.0;
    std::printf("level %.3f mm, volume %+.2f %%\n", measurement.liquid.level_mm, 100.0 * error);
    EXPECT_EQ(measurement.liquid.label, 2);
    EXPECT_NEAR(measurement.liquid.level_mm, kLevelMm, 0.15);
    EXPECT_LT(std::abs(error), GetParam().max_volume_error);
  }
}

void expect_no_liquid(const SolidScene& scene) {
  for (const CameraPair& cameras : {kFromAbove, kAslant}) {
    const TwoViews seen(scene, cameras);
    const ContactLevel contact = seen.contact(2);
    HeightMeasurement measurement;
    ASSERT_TRUE(measurement.run(seen.views(), scene.dish).ok());
    const double error = measurement.item(2).column_volume_ml / scene.column_ml(2) - 1.0;
    std::printf("contact %.2f mm, share %.2f, volume %+.2f %%\n", contact.level_mm, contact.share,
                100.0 * error);
    EXPECT_EQ(measurement.liquid.label, 0);
    EXPECT_LT(std::abs(error), 0.02) << "left as it is";
  }
}

TEST(LevelLiquidOnPlate, AHeapIsNone) {
  SolidScene scene;
  scene.dish = test::dinner_plate();
  scene.solids = {test::heap(2, scene.dish.place.centre_mm, {60, 55}, 4.5, 28, 4, 12, 3)};
  expect_no_liquid(scene);
}

// Its lid is level, and its round side ends at the wall at one height.
TEST(LevelLiquidOnPlate, ASliceAtTheWallOnOneSideIsNone) {
  SolidScene scene;
  scene.dish = test::dinner_plate();
  test::Solid slice = test::liquid(2, scene.dish, 12.0);
  const auto whole = slice.top;
  const double middle_mm = scene.dish.place.centre_mm.x();
  slice.top = [whole, middle_mm](const Vec2& at) {
    return at.x() > middle_mm + 5.0 ? whole(at) : test::kNothingMm;
  };
  scene.solids = {slice};
  expect_no_liquid(scene);
}

}  // namespace
}  // namespace traygauge
