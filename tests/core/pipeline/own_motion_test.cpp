// Dishes that slid between two views: the motion that their rims show, and the camera in their frame.
#include "core/pipeline/own_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/core/dish/edge_outlines.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

class OwnMotions : public ::testing::Test {
 protected:
  DishPose dish_at(const Vec2& centre_mm) {
    DishPose place;
    place.centre_mm = centre_mm;
    place.edge_height_mm = 22.0;
    place.size_mm = {260.0, 260.0};
    place.edge_drop_mm = 1.0;
    return place;
  }
  SightedDish sight(const DishPose& first, const DishPose& second) {
    std::normal_distribution<double> noise(0.0, 0.15 / test::kOutlineFocalPx);
    DishSightingParams params;
    params.points_for_one = 1.0;
    SightedDish dish;
    dish.size_mm = mean_size_mm(first);
    dish.is_round = true;
    for (std::size_t v = 0; v < 2; ++v) {
      const DishPose& place = v == 0 ? first : second;
      std::vector<Vec2> rays = test::outline_of(place, cameras_[v], 160);
      for (Vec2& ray : rays) ray += Vec2(noise(random_), noise(random_));
      DishPose about = place;
      about.centre_mm += Vec2(2.0, -2.0);
      about.size_mm = {260.0, 260.0};
      dish.sightings[v] = sight_dish(rays, cameras_[v], test::kOutlineFocalPx, about, params);
      EXPECT_TRUE(dish.sightings[v].is_known);
    }
    return dish;
  }
  SightedDish slid(const Vec2& centre_mm, const Vec2& slip_mm) {
    return sight(dish_at(centre_mm), dish_at(centre_mm + slip_mm));
  }
  OwnMotion find(std::span<const SightedDish> dishes) const {
    return find_own_motion(dishes, cameras_, CamerasMatrix::Zero(), {});
  }
  Vec2 direction() {
    const double angle = std::uniform_real_distribution<double>(0.0, 6.28)(random_);
    return {std::cos(angle), std::sin(angle)};
  }

  std::mt19937 random_{test::random_seed()};
  std::normal_distribution<double> normal_;
  TableCameras cameras_ = {test::camera_at(8.0, 30.0), test::camera_at(26.0, 75.0)};
};

TEST_F(OwnMotions, AreFoundUpToWhatCanBeFollowed) {
  for (int round = 0; round < 20; ++round) {
    const Vec2 slip_mm = (2.5 + 0.4 * round) * direction();
    const SightedDish dish = slid(20.0 * direction(), slip_mm);
    const OwnMotion motion = find({&dish, 1});
    ASSERT_TRUE(motion.is_known) << slip_mm.norm();
    EXPECT_LT((motion.shift_mm - slip_mm).norm(), 1.0);
    EXPECT_GT(motion.turn_sigma_rad, 0.0);
  }
  const SightedDish far = slid({0.0, 0.0}, 20.0 * direction());
  EXPECT_FALSE(find({&far, 1}).is_known);
  EXPECT_TRUE(find({&far, 1}).is_too_far);
}

TEST_F(OwnMotions, AreUnknownWhereSomethingElseIsWrong) {
  for (int round = 0; round < 20; ++round) {
    const SightedDish still = slid(20.0 * direction(), Vec2::Zero());
    EXPECT_FALSE(find({&still, 1}).is_known);
  }
  DishPose larger = dish_at({10.0, 0.0});
  larger.size_mm = {272.0, 272.0};
  const SightedDish scaled = sight(larger, larger);
  EXPECT_FALSE(find({&scaled, 1}).is_known);
  EXPECT_FALSE(find({}).is_known);
}

// Else the card moved, and in the frame of one dish the others would have.
TEST_F(OwnMotions, AreThoseOfAllDishes) {
  const Vec2 slip_mm = 5.0 * direction();
  const std::array<SightedDish, 2> alike = {slid({-60.0, 0.0}, slip_mm), slid({70.0, 10.0}, slip_mm)};
  EXPECT_TRUE(find(alike).is_known);
  const std::array<SightedDish, 2> one = {slid({-60.0, 0.0}, slip_mm), slid({70.0, 10.0}, Vec2::Zero())};
  EXPECT_FALSE(find(one).is_known);
  const std::array<SightedDish, 2> apart = {slid({-60.0, 0.0}, slip_mm), slid({70.0, 10.0}, -slip_mm)};
  EXPECT_FALSE(find(apart).is_known);
}

TEST_F(OwnMotions, MoveTheTableAndBack) {
  const OwnMotion motion{true, false, {30.0, -20.0}, {4.0, 7.0}, 0.1, 0.5, 0.05};
  const Vec3 centre_mm(30.0, -20.0, 12.0);
  EXPECT_LT((motion.pose() * centre_mm - Vec3(34.0, -13.0, 12.0)).norm(), 1e-9);
  const Vec3 point_mm(-50.0, 60.0, 5.0);
  EXPECT_LT((motion.reversed().pose() * (motion.pose() * point_mm) - point_mm).norm(), 1e-9);
}

// The camera over dishes whose motion is known with these errors only: as many draws spread as it says.
TEST_F(OwnMotions, SpreadTheCameraAsTheyAreKnown) {
  const OwnMotion motion{true, false, {30.0, -20.0}, {4.0, 7.0}, 0.0, 0.8, 0.04};
  const CardPrior second{cameras_[1], Mat6::Identity() * 1e10};
  const CardPrior moved = card_in_frame_of(motion, second);
  constexpr int kDraws = 4000;
  Mat6 spread = Mat6::Zero();
  for (int i = 0; i < kDraws; ++i) {
    OwnMotion drawn = motion;
    drawn.shift_mm += 0.8 * Vec2(normal_(random_), normal_(random_));
    drawn.turn_rad += 0.04 * normal_(random_);
    const Vec6 step = step_between(moved.camera_from_table, second.camera_from_table * drawn.pose());
    spread += step * step.transpose() / kDraws;
  }
  const Mat6 stated = moved.information.inverse();
  // Each variance is known to 2.2 %; what the card tells exactly has none.
  for (Eigen::Index i = 0; i < 6; ++i) {
    if (stated(i, i) < 1e-8) {
      EXPECT_LT(spread(i, i), 1e-8) << i;
    } else {
      EXPECT_NEAR(std::sqrt(spread(i, i) / stated(i, i)), 1.0, 0.1) << i;
    }
  }
  EXPECT_LT((spread - stated).norm(), 0.15 * stated.norm());
}

}  // namespace
}  // namespace traygauge
