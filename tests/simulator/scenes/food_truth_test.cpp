#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "simulator/scenes/height_mesh.hpp"
#include "simulator/scenes/laid_food.hpp"
#include "simulator/scenes/laid_scene.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scene_parts.hpp"

namespace traygauge {
namespace {

constexpr double kAgreement = 0.002;  // of two ways to the same volume

SceneDescription one_food(DishStyle style, const FoodKind& kind, std::uint64_t seed) {
  Draws draws(seed);
  SceneDescription scene;
  scene.dishes.push_back(draw_dish(draws, style, 1.0, 1));
  LaidFood food;
  food.kind = food.name = kind.name;
  food.centre_mm = {-12.0, 7.0};
  food.rotation_deg = 25.0;
  food.size = kind.size;
  food.seed = seed;
  food.level_mm = 24.0;
  scene.foods.push_back(food);
  return scene;
}

ServedFood serve_one(const SceneDescription& scene) {
  return serve_foods(scene, 0, DishShell(scene.dishes.front().dish), 2).front();
}

TEST(FoodTruth, EveryKindHasOneVolumeInTwoWaysAndAClosedMesh) {
  constexpr std::uint64_t kSeed = 44;
  for (const FoodKind& kind : food_kinds()) {
    const ServedFood food = serve_one(one_food(DishStyle::soup, kind, kSeed));
    EXPECT_GT(food.volume_ml, 20.0) << kind.name;
    EXPECT_LT(food.max_height_mm, kind.is_filled() ? 45.0 : 1.6 * kind.size.height_mm) << kind.name;
    EXPECT_NEAR(food.check_volume_ml / food.volume_ml, 1.0, kAgreement) << kind.name;
    // Its mesh has vertices in single precision, some of them double at the edge.
    EXPECT_NEAR(1e-3 * enclosed_volume_mm3(food.object.mesh) / food.volume_ml, 1.0, 1e-4) << kind.name;
  }
}

TEST(FoodTruth, TheSamePortionHasTheSameVolumeOnEveryDish) {
  for (const char* name : {"mash", "peas", "schnitzel", "fries"}) {
    const FoodKind& kind = *find_food_kind(name);
    const double dinner_ml = serve_one(one_food(DishStyle::dinner, kind, 5)).volume_ml;
    EXPECT_NEAR(serve_one(one_food(DishStyle::soup, kind, 5)).volume_ml, dinner_ml, 1e-4 * dinner_ml) << name;
    EXPECT_NEAR(serve_one(one_food(DishStyle::oval, kind, 5)).volume_ml, dinner_ml, 1e-4 * dinner_ml) << name;
  }
}

TEST(FoodTruth, FoodsThatMeetShareNoVolume) {
  SceneDescription scene = one_food(DishStyle::dinner, *find_food_kind("mash"), 8);
  const double alone_ml = serve_one(scene).volume_ml;
  scene.foods.push_back(scene.foods.front());
  scene.foods.back().seed = 9;
  scene.foods.back().centre_mm.x() += 30.0;
  const auto foods = serve_foods(scene, 0, DishShell(scene.dishes.front().dish), 2);
  ASSERT_EQ(foods.size(), 2U);
  EXPECT_NEAR(foods[0].volume_ml, alone_ml, 1e-6 * alone_ml);
  SceneDescription second = scene;
  second.foods.erase(second.foods.begin());
  const double second_alone_ml = serve_one(second).volume_ml;
  EXPECT_LT(foods[1].volume_ml, 0.8 * second_alone_ml);
  EXPECT_NEAR(foods[1].check_volume_ml / foods[1].volume_ml, 1.0, kAgreement);
}

TEST(FoodTruth, IsTheSameForAnyNumberOfThreads) {
  SceneDescription scene = one_food(DishStyle::dinner, *find_food_kind("fries"), 8);
  scene.foods.push_back(scene.foods.front());
  scene.foods.back().seed += 1;
  scene.foods.back().centre_mm.x() += 20.0;
  const DishShell shell(scene.dishes.front().dish);
  const auto alone = serve_foods(scene, 0, shell, 2, 1);
  const auto together = serve_foods(scene, 0, shell, 2, 3);
  ASSERT_EQ(alone.size(), 2U);
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(together[i].object.label, alone[i].object.label);
    EXPECT_EQ(together[i].volume_ml, alone[i].volume_ml);
    EXPECT_EQ(together[i].check_volume_ml, alone[i].check_volume_ml);
    EXPECT_EQ(together[i].object.mesh.vertices, alone[i].object.mesh.vertices);
  }
}

TEST(FoodTruth, VolumesThatContradictEachOtherAreRefused) {
  ServedFood food;
  food.name = "peas";
  food.volume_ml = 100.0;
  food.check_volume_ml = 100.19;
  EXPECT_NO_THROW(require_agreement(food));
  food.check_volume_ml = 99.79;
  try {
    require_agreement(food);
    FAIL() << "0.21 % apart";
  } catch (const std::invalid_argument& problem) {
    const std::string text = problem.what();
    for (const char* part : {"peas", "100.000 ml", "99.790 ml"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
  constexpr double kQuickStepMm = 0.6;
  EXPECT_NO_THROW(require_agreement(food, kQuickStepMm));
  food.check_volume_ml = 98.9;
  EXPECT_THROW(require_agreement(food, kQuickStepMm), std::invalid_argument);
}

// A crumb's edge is a few squares of the grid: 0.2 % of it would ask more of the grids than they have.
TEST(FoodTruth, SmallPortionsAreNotRefusedForTheGridsStep) {
  for (const char* name : {"red_cabbage", "coleslaw"}) {
    SceneDescription scene = one_food(DishStyle::dinner, *find_food_kind(name), 3);
    FoodSize& size = scene.foods[0].size;
    for (double* side_mm : {&size.length_mm, &size.width_mm, &size.height_mm}) *side_mm *= 0.4;
    const ServedFood food = serve_one(scene);
    EXPECT_GT(std::abs(food.check_volume_ml - food.volume_ml), kAgreement * food.volume_ml) << name;
  }
}

// A half ball on a cylinder: what a height field makes of a ball whose middle is higher than its radius.
TEST(FoodTruth, APaintedBallHasItsClosedForm) {
  constexpr double kRadiusMm = 14.0;
  constexpr double kMiddleMm = 17.0;
  HeightField field(frame_around(40.0, 0.3));
  FoodPainter painter(field, {3.1, -4.7}, 17.0);
  painter.superquadric({{2.0, 1.0, kMiddleMm}, Eigen::Vector3d::Constant(kRadiusMm)}, food_part(0, 0));
  const double exact_mm3 = std::numbers::pi * kRadiusMm * kRadiusMm * (kMiddleMm + 2.0 / 3.0 * kRadiusMm);
  EXPECT_NEAR(quadrature_mm3(field), exact_mm3, 1e-3 * exact_mm3);
  extend_outward(field);
  const GroundHeight ground = [](double x, double y) { return 5.0 + 0.1 * x - 0.05 * y; };
  const FoodSolid solid = mesh_of_field(field, ground, ground, 0.0);
  EXPECT_NEAR(solid.volume_mm3, exact_mm3, 1e-3 * exact_mm3);
  EXPECT_NEAR(solid.footprint_mm2, std::numbers::pi * kRadiusMm * kRadiusMm, 0.5);
  EXPECT_TRUE(std::isfinite(solid.max_height_mm));
}

TEST(FoodTruth, APaintedBoxHasItsClosedForm) {
  HeightField field(frame_around(50.0, 0.25));
  FoodPainter painter(field, {0.0, 0.0}, 31.0);
  Superquadric box{{0.0, 0.0, 9.0}, {21.0, 12.0, 9.0}};
  box.side_exponent = box.height_exponent = 400.0;
  painter.superquadric(box, food_part(0, 0));
  EXPECT_NEAR(quadrature_mm3(field), 42.0 * 24.0 * 18.0, 0.01 * 42.0 * 24.0 * 18.0);
}

// Straight walls: a liquid is a truncated cone.
TEST(FoodTruth, ALiquidInAConeHasItsClosedForm) {
  SceneDescription scene = one_food(DishStyle::dinner, *find_food_kind("vegetable_soup"), 2);
  DishDescription& dish = scene.dishes.front().dish;
  dish.outer_size_mm = {160.0, 160.0};
  dish.rim_height_mm = 50.0;
  dish.bottom_height_mm = 5.0;
  dish.profile = {{0.0, 50.0}, {30.0, 5.0}};
  HeightField field(frame_around(80.0, 0.3));
  const DishShell shell(dish);
  constexpr double kLevelMm = 32.0;
  for (int row = 0; row < field.frame.rows; ++row) {
    for (int column = 0; column < field.frame.columns; ++column) {
      const Eigen::Vector2d at = field.frame.node(column, row);
      field.inside_mm[field.frame.index(column, row)] =
          static_cast<float>(kLevelMm - shell.inner_height_mm(at.x(), at.y()));
    }
  }
  extend_outward(field);
  const double bottom_mm = 50.0;                             // radius of the flat bottom
  const double top_mm = 80.0 - 30.0 * (50.0 - 32.0) / 45.0;  // radius at the level
  const double exact_mm3 = std::numbers::pi * (kLevelMm - 5.0) / 3.0 *
                           (bottom_mm * bottom_mm + bottom_mm * top_mm + top_mm * top_mm);
  const FoodSolid solid = mesh_of_field(
      field, [](double, double) { return kLevelMm; },
      [&](double x, double y) { return shell.inner_height_mm(x, y); }, 5.0);
  EXPECT_NEAR(solid.volume_mm3, exact_mm3, 5e-4 * exact_mm3);
}

TEST(DishShell, IsASolidOfPorcelain) {
  for (const DishStyle style :
       {DishStyle::dinner, DishStyle::soup, DishStyle::oval, DishStyle::bowl, DishStyle::dessert_bowl}) {
    Draws draws(1);
    const DishShell shell(draw_dish(draws, style, 1.0, 1).dish);
    const TriangleMesh mesh = shell.mesh();
    EXPECT_TRUE(is_closed(mesh));
    const double plan_mm2 = std::numbers::pi * shell.semi_axis_mm(0) * shell.semi_axis_mm(1);
    const double thickness_mm = enclosed_volume_mm3(mesh) / plan_mm2;
    EXPECT_GT(thickness_mm, 2.0);
    EXPECT_LT(thickness_mm, 12.0);
  }
}

}  // namespace
}  // namespace traygauge
