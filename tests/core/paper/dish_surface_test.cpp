#include "core/paper/surface/dish_surface.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/dish/rim_ellipse.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

class DishTest : public ::testing::Test {
 protected:
  // Rim 22 mm above the table, the card 200 mm aside, its plane tilted by 2 degrees about its own middle.
  void SetUp() override {
    for (int i = 0; i < 60; ++i) {
      const double angle = 0.1 * i;
      rim_points_.emplace_back(130.0 * std::cos(angle), 130.0 * std::sin(angle), 478.0);
    }
    for (int i = 0; i < 40; ++i)
      card_points_.emplace_back(200.0 + (i % 8) * 5.0 - 17.5, (i / 8) * 5.0, 499.2);
    const Vec3 normal = Vec3(0.035, 0.0, -1.0).normalized();
    input_.rim = {-Vec3::UnitZ(), -478.0};
    input_.rim_points_mm = rim_points_;
    input_.table = {normal, normal.dot(Vec3(200.0, 10.0, 500.0))};
    input_.card_points_mm = card_points_;
    input_.card_thickness_mm = 0.8;
  }

  std::vector<Vec3> rim_points_;
  std::vector<Vec3> card_points_;
  DishInput input_;
  test::Allocated<DishWorkspace> space_{std::size_t{128}};
};

TEST_F(DishTest, CardPointsUnderTheRimPlaneIgnoreTheCardsTilt) {
  double height = 0.0;
  ASSERT_TRUE(measure_rim_height(input_, {}, *space_, height).ok());
  EXPECT_NEAR(height, 22.0, 1e-9);
  const Plane bottom = place_dish_bottom(input_, {}, height, 4.5);
  EXPECT_NEAR(bottom.height(Vec3(0, 0, 500.0)), -4.5, 1e-9);
  EXPECT_NEAR(bottom.height(Vec3(90, -50, 478.0)), 17.5, 1e-9);
}

TEST_F(DishTest, CardAloneRaisesTheTableAndCarriesTheCardsTiltToTheDish) {
  DishParams params;
  params.surface = DishSurface::card_alone;
  params.mode.halvings = 0;
  double height = 0.0;
  ASSERT_TRUE(measure_rim_height(input_, params, *space_, height).ok());
  EXPECT_NEAR(height, 22.0 - 0.035 * 200.0, 0.6);  // 2 degrees over 200 mm
  const Plane bottom = place_dish_bottom(input_, params, height, 4.5);
  EXPECT_EQ(bottom.normal, input_.table.normal);
  EXPECT_NEAR(bottom.height(Vec3(200.0, 10.0, 500.0)), -4.5, 1e-9);
}

TEST_F(DishTest, SaysWhichPointsAreMissing) {
  double height = 0.0;
  input_.card_points_mm = {};
  EXPECT_EQ(measure_rim_height(input_, {}, *space_, height).code(), StatusCode::table_not_found);
  DishParams params;
  params.surface = DishSurface::card_alone;
  input_.rim_points_mm = {};
  EXPECT_EQ(measure_rim_height(input_, params, *space_, height).code(), StatusCode::rim_not_found);
}

TEST(RimEllipse, FindsSizePlaceAndDirectionFromAnArc) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const Plane plane{Vec3(uniform(generator) - 0.5, uniform(generator) - 0.5, -1.0).normalized(), -450.0};
    const Vec3 long_axis = plane.normal.cross(Vec3(uniform(generator), 1.0, 0.0)).normalized();
    const Vec3 short_axis = plane.normal.cross(long_axis);
    const Vec3 centre = plane.normal * plane.offset + 20.0 * long_axis;
    std::vector<Vec3> points;
    for (double angle = 0.0; angle < 4.0; angle += 0.05) {
      points.emplace_back(centre + 150.0 * std::cos(angle) * long_axis +
                          105.0 * std::sin(angle) * short_axis);
    }
    const Result<RimEllipse> ellipse = fit_rim_size(points, plane);
    ASSERT_TRUE(ellipse.ok());
    EXPECT_NEAR(ellipse->size_mm[0], 300.0, 1e-6);
    EXPECT_NEAR(ellipse->size_mm[1], 210.0, 1e-6);
    EXPECT_LT((ellipse->centre_mm - centre).norm(), 1e-6);
    EXPECT_NEAR(std::abs(ellipse->axes[0].dot(long_axis)), 1.0, 1e-9);
  }
}

TEST(RimEllipse, RefusesALine) {
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) points.emplace_back(i, 0.0, 450.0);
  EXPECT_EQ(fit_rim_size(points, {-Vec3::UnitZ(), -450.0}).code(), StatusCode::rim_not_found);
}

TEST(ChooseDish, TakesTheNearestWithinTolerance) {
  const std::array<DishCandidate, 4> dishes{
      {{{260, 260}, 22}, {{210, 300}, 24}, {{230, 230}, 40}, {{262, 262}, 26}}};
  EXPECT_EQ(choose_dish(dishes, {259, 258}, 21.0, {}), 0);
  EXPECT_EQ(choose_dish(dishes, {301, 209}, 23.0, {}), 1);  // whichever axis comes first
  EXPECT_EQ(choose_dish(dishes, {228, 227}, 38.0, {}), 2);
  EXPECT_EQ(choose_dish(dishes, {261, 261}, 26.5, {}), 3);
  EXPECT_EQ(choose_dish(dishes, {230, 230}, 22.0, {}), -1);  // a rim 18 mm lower is another dish
  EXPECT_EQ(choose_dish({}, {230, 230}, 22.0, {}), -1);
}

}  // namespace
}  // namespace traygauge::paper
