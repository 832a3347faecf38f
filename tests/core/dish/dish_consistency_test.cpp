// A dish in two views that slipped, is larger or stands higher than described: the amount found against the
// one that the outlines were made with, and what no fault gives by chance.
#include "core/dish/dish_consistency.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/core/dish/edge_outlines.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kNoisePx = 0.15;
const DishConsistencyParams kParams;

class DishConsistencies : public ::testing::Test {
 protected:
  DishPose described() {
    DishPose place;
    place.centre_mm = 40.0 * Vec2(unit(), unit());
    place.azimuth_rad = unit();
    place.edge_height_mm = 24.0;
    place.size_mm = {290.0, 210.0};
    place.edge_drop_mm = 1.0;
    return place;
  }
  // What both views show of dishes that stand like this, and what the description says of it.
  DishConsistency compare(const DishPose& described, const DishPose& first, const DishPose& second) {
    return compare(described, first, second, cameras_);
  }
  // Seen by other cameras than are believed.
  DishConsistency compare(const DishPose& described, const DishPose& first, const DishPose& second,
                          const TableCameras& seen_by) {
    std::normal_distribution<double> noise(0.0, kNoisePx / test::kOutlineFocalPx);
    DishSightingParams params;
    params.points_for_one = 1.0;
    std::array<DishSighting, 2> sightings;
    for (std::size_t v = 0; v < 2; ++v) {
      std::vector<Vec2> rays = test::outline_of(v == 0 ? first : second, seen_by[v], 160);
      for (Vec2& ray : rays) ray += Vec2(noise(random_), noise(random_));
      sightings[v] = sight_dish(rays, cameras_[v], test::kOutlineFocalPx, described, params);
      EXPECT_TRUE(sightings[v].is_known);
    }
    return compare_sightings(sightings, cameras_, CamerasMatrix::Zero(), 250.0, kParams);
  }
  static double left(const DishConsistency& dish, DishFault fault) {
    return dish.left[static_cast<std::size_t>(fault)];
  }
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }

  std::mt19937 random_{test::random_seed()};
  TableCameras cameras_ = {test::camera_at(8.0, 30.0), test::camera_at(26.0, 75.0)};
};

TEST_F(DishConsistencies, FindNothingWhereNothingIsWrong) {
  for (int round = 0; round < 50; ++round) {
    const DishPose place = described();
    const DishConsistency dish = compare(place, place, place);
    // Four degrees of freedom: by chance once in a million. Tolerances of size and height make it rarer.
    EXPECT_LT(dish.squared_deviation, 33.4);
    EXPECT_LT(dish.slip_mm.norm(), 0.6);
  }
}

TEST_F(DishConsistencies, TellHowTheDishSlipped) {
  for (int round = 0; round < 30; ++round) {
    const DishPose place = described();
    DishPose slipped = place;
    const Vec2 slip_mm = (3.0 + 3.0 * std::abs(unit())) * Vec2(unit(), unit()).normalized();
    slipped.centre_mm += slip_mm;
    slipped.azimuth_rad += 0.05 * unit();
    const DishConsistency dish = compare(place, place, slipped);
    EXPECT_GT(dish.squared_deviation, 100.0);
    EXPECT_LT((dish.slip_mm - slip_mm).norm(), 1.0);
    EXPECT_NEAR(dish.turn_rad, slipped.azimuth_rad - place.azimuth_rad, 3e-3);
    EXPECT_LT(left(dish, DishFault::slip), left(dish, DishFault::scale));
  }
}

// What explains most comes first; a slip needs to explain more by its further degree of freedom.
TEST(DishConsistencyOrder, PutsFirstWhatLeavesLeast) {
  DishConsistency dish;
  dish.squared_deviation = 40.0;
  dish.left = {12.0, 30.0, 3.0};
  EXPECT_EQ(dish.best_first(), (std::array{DishFault::height, DishFault::slip, DishFault::scale}));
  EXPECT_EQ(dish.explained_by(DishFault::height), 37.0);
  dish.left = {4.0, 4.5, 30.0};
  EXPECT_EQ(dish.best_fault(), DishFault::scale);
  dish.left = {4.0, 5.5, 30.0};
  EXPECT_EQ(dish.best_fault(), DishFault::slip);
}

// A card printed too small makes everything too large.
TEST_F(DishConsistencies, TellAWrongScale) {
  for (const double scale : {-0.04, -0.02, 0.02, 0.04}) {
    const DishPose place = described();
    DishPose larger = place;
    for (double& axis : larger.size_mm) axis *= 1.0 + scale;
    const DishConsistency dish = compare(place, larger, larger);
    EXPECT_NEAR(dish.scale, scale, 0.005);
    EXPECT_GT(dish.squared_deviation, 28.5);
    EXPECT_LT(left(dish, DishFault::scale), left(dish, DishFault::slip));
    EXPECT_LT(left(dish, DishFault::scale), left(dish, DishFault::height));
  }
}

TEST_F(DishConsistencies, TellADishThatStandsHigherThanTheTable) {
  for (const double height_mm : {-5.0, 4.0, 6.0}) {
    const DishPose place = described();
    DishPose higher = place;
    higher.edge_height_mm += height_mm;
    const DishConsistency dish = compare(place, higher, higher);
    EXPECT_NEAR(dish.height_mm, height_mm, 1.0);
    EXPECT_GT(dish.squared_deviation, 28.5);
    EXPECT_LT(left(dish, DishFault::height), left(dish, DishFault::scale));
  }
}

// The less is known of the cameras, the less a motion says.
TEST_F(DishConsistencies, BlameTheCamerasFirst) {
  const DishPose place = described();
  DishPose slipped = place;
  slipped.centre_mm.x() += 2.0;
  std::array<DishSighting, 2> sightings;
  for (std::size_t v = 0; v < 2; ++v) {
    sightings[v] = sight_dish(test::outline_of(v == 0 ? place : slipped, cameras_[v], 160), cameras_[v],
                              test::kOutlineFocalPx, place, {});
  }
  const auto squared_deviation = [&](double sigma_mm) {
    CamerasMatrix covariance = CamerasMatrix::Zero();
    covariance.diagonal().segment<3>(3).setConstant(sigma_mm * sigma_mm);
    covariance.diagonal().segment<3>(9).setConstant(sigma_mm * sigma_mm);
    return compare_sightings(sightings, cameras_, covariance, 250.0, kParams).squared_deviation;
  };
  EXPECT_GT(squared_deviation(0.1), 28.5);
  EXPECT_LT(squared_deviation(3.0), 5.0);
}

// A dish that turned about a level axis through the middle of its edge looks as it does to cameras that
// turned the other way.
TEST_F(DishConsistencies, TellHowFarADishLeansAgainstTheCard) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (int round = 0; round < 20; ++round) {
    DishPose place = described();
    place.size_mm = {260.0, 260.0};
    const double axis_rad = std::numbers::pi * unit();
    const double lean_rad = 0.2 * (round % 4) * kDegree;
    const Vec3 axis(std::cos(axis_rad), std::sin(axis_rad), 0.0);
    const Mat3 turn = rotation_about(lean_rad * axis);
    const Vec3 pivot_mm(place.centre_mm.x(), place.centre_mm.y(), place.edge_height_mm);
    TableCameras seen_by = cameras_;
    for (Pose& camera : seen_by)
      camera = {camera.rotation * turn, camera.translation + camera.rotation * (pivot_mm - turn * pivot_mm)};
    const DishConsistency dish = compare(place, place, place, seen_by);
    EXPECT_NEAR(dish.lean_rad, lean_rad, 5.0 * dish.lean_sigma_rad + 0.15 * lean_rad) << lean_rad / kDegree;
    EXPECT_LT(dish.lean_sigma_rad, 0.2 * kDegree);
    // Two degrees of freedom: by chance once in a million.
    if (round % 4 == 0) {
      EXPECT_LT(dish.lean_deviation, 27.6);
    } else if (round % 4 == 3) {
      EXPECT_GT(dish.lean_deviation, 10.8);
    }
  }
}

}  // namespace
}  // namespace traygauge
