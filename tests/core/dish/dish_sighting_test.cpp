// Where one view alone puts a dish, and how large it looks: against what its outline was made from; the
// stated covariance against the spread of many noisy outlines.
#include "core/dish/dish_sighting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/core/dish/edge_outlines.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

DishPose dish_at(const Vec2& centre_mm, double azimuth_rad, const std::array<double, 2>& size_mm) {
  DishPose place;
  place.centre_mm = centre_mm;
  place.azimuth_rad = azimuth_rad;
  place.edge_height_mm = 24.0;
  place.size_mm = size_mm;
  place.edge_drop_mm = 1.0;
  return place;
}

class DishSightings : public ::testing::Test {
 protected:
  // Rays on the outline, each off by its own normal error.
  std::vector<Vec2> outline(const DishPose& place, const Pose& camera, double noise_px) {
    std::normal_distribution<double> noise(0.0, noise_px / test::kOutlineFocalPx);
    std::vector<Vec2> rays = test::outline_of(place, camera, 160);
    for (Vec2& ray : rays) ray += Vec2(noise(random_), noise(random_));
    return rays;
  }
  // Points are independent here, while those of real outlines are not.
  static DishSighting sight(const std::vector<Vec2>& rays, const Pose& camera, const DishPose& about) {
    DishSightingParams params;
    params.points_for_one = 1.0;
    return sight_dish(rays, camera, test::kOutlineFocalPx, about, params);
  }
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }

  std::mt19937 random_{test::random_seed()};
  Pose first_ = test::camera_at(8.0, 30.0);
  Pose second_ = test::camera_at(26.0, 75.0);
};

TEST_F(DishSightings, PutTheDishWhereItStands) {
  for (int round = 0; round < 50; ++round) {
    const bool is_round = round % 2 == 0;
    const DishPose place = dish_at(40.0 * Vec2(unit(), unit()), unit(),
                                   is_round ? std::array{260.0, 260.0} : std::array{290.0, 210.0});
    DishPose about = place;
    about.centre_mm += 4.0 * Vec2(unit(), unit());
    if (!is_round) about.azimuth_rad += 0.05 * unit();
    const DishSighting sighting = sight(outline(place, second_, 0.0), second_, about);
    ASSERT_TRUE(sighting.is_known);
    EXPECT_LT((sighting.place.head<2>() - place.centre_mm).norm(), 0.05);
    EXPECT_NEAR(sighting.place[kSightedSize], 0.0, 2e-4);
    EXPECT_NEAR(sighting.place[kPlaceAzimuth], is_round ? about.azimuth_rad : place.azimuth_rad, 1e-3);
  }
}

TEST_F(DishSightings, KnowHowFarTheyCanBeOff) {
  constexpr int kRounds = 300;
  const DishPose place = dish_at({20.0, -15.0}, 0.4, {290.0, 210.0});
  SightedMatrix spread = SightedMatrix::Zero();
  SightedMatrix stated = SightedMatrix::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const DishSighting sighting = sight(outline(place, second_, 0.4), second_, place);
    ASSERT_TRUE(sighting.is_known);
    SightedVector off = sighting.place;
    off.head<2>() -= place.centre_mm;
    off[kPlaceAzimuth] -= place.azimuth_rad;
    spread += off * off.transpose() / kRounds;
    stated += sighting.covariance / kRounds;
  }
  // Standard deviations of 300 draws spread by 4 %.
  for (int i = 0; i < kSightedParameters; ++i)
    EXPECT_NEAR(std::sqrt(spread(i, i) / stated(i, i)), 1.0, 0.2) << i;
}

// A camera that is off moves the place as the derivative says: what the sighting was made with may be mended.
TEST_F(DishSightings, FollowTheCamera) {
  const DishPose place = dish_at({-10.0, 25.0}, 0.8, {290.0, 210.0});
  const std::vector<Vec2> rays = outline(place, second_, 0.0);
  const DishSighting before = sight(rays, second_, place);
  Eigen::Matrix<double, 6, 1> step;
  step << 1e-4 * Vec3(unit(), unit(), unit()), 0.1 * Vec3(unit(), unit(), unit());
  const DishSighting after = sight(rays, moved(second_, step), place);
  ASSERT_TRUE(before.is_known && after.is_known);
  const SightedVector told = before.place_from(moved(second_, step));
  EXPECT_LT((told - after.place).norm(), 0.02 * (after.place - before.place).norm() + 1e-3);
}

// Every third point on another edge of the same rim, as where it is painted: nothing is said.
TEST_F(DishSightings, AreNotKnownWhereTheRimShowsTwoEdges) {
  const DishPose place = dish_at({10.0, 5.0}, 0.0, {260.0, 260.0});
  DishPose painted = place;
  painted.size_mm = {252.0, 252.0};
  std::vector<Vec2> rays = outline(place, second_, 0.1);
  const std::vector<Vec2> inner = outline(painted, second_, 0.1);
  EXPECT_TRUE(sight(rays, second_, place).is_known);
  for (std::size_t i = 0; i < rays.size(); i += 3) rays[i] = inner[i];
  EXPECT_FALSE(sight(rays, second_, place).is_known);
}

TEST_F(DishSightings, AreNotKnownFromAFewPoints) {
  const DishPose place = dish_at({0.0, 0.0}, 0.0, {260.0, 260.0});
  std::vector<Vec2> rays = outline(place, first_, 0.1);
  rays.resize(10);
  EXPECT_FALSE(sight(rays, first_, place).is_known);
}

}  // namespace
}  // namespace traygauge
