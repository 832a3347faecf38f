// Lines of sight down to a known dish, against closed form, marching, and the ray caster of the scenes.
#include "core/stereo/dish_projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "core/volume/matched_fraction.hpp"
#include "tests/core/stereo/solid_scene.hpp"

namespace traygauge {
namespace {

constexpr unsigned kSeed = 77;
constexpr int kRays = 20000;
constexpr double kToleranceMm = 0.02;

struct Sight {
  Vec3 eye_mm;
  Vec2 run_per_mm;

  Vec2 at(double z_mm) const { return eye_mm.head<2>() + (eye_mm.z() - z_mm) * run_per_mm; }
};

// From where cameras stand to a place inside the edge, `height_mm` over the table.
class RandomSights {
 public:
  explicit RandomSights(const InnerSurface& dish) : dish_(dish) { std::printf("seed %u\n", kSeed); }

  Sight next() {
    const double tilt = draw(0.0, 0.65);
    const double azimuth = draw(-M_PI, M_PI);
    const Vec3 back(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
    const Vec2& centre = dish_.place.centre_mm;
    const Vec3 eye = Vec3(centre.x(), centre.y(), 10.0) + draw(350.0, 650.0) * back;
    Vec2 at;
    do {
      const double reach = dish_.profile.semi_axes_mm().maxCoeff();
      at = centre + Vec2(draw(-reach, reach), draw(-reach, reach));
    } while (dish_.profile.inset_mm(dish_.to_dish(at)) < 0.0);
    return {eye, (at - eye.head<2>()) / (eye.z() - dish_.height_mm(at))};
  }

 private:
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  const InnerSurface& dish_;
  std::mt19937 random_{kSeed};
};

InnerSurface flat_dish(double height_mm) {
  DishModel model;
  model.outer_size_mm = {240.0, 180.0};
  model.bottom_height_mm = height_mm;
  model.rim_height_mm = height_mm + 20.0;
  InnerSurface dish;
  EXPECT_TRUE(dish.profile.set(model).ok());
  dish.place = {{40.0, -25.0}, {0.6, 0.8}};
  return dish;
}

// The wall's height is 0.4 times the radius less 10 mm, from 6 mm at 40 mm to 30 mm at 100 mm.
InnerSurface conical_dish() {
  DishModel model;
  model.outer_size_mm = {200.0, 200.0};
  model.profile_points[0] = {0.0, 30.0};
  model.profile_points[1] = {60.0, 6.0};
  model.profile_size = 2;
  model.bottom_height_mm = 6.0;
  model.rim_height_mm = 30.0;
  InnerSurface dish;
  EXPECT_TRUE(dish.profile.set(model).ok());
  dish.place.centre_mm = {-70.0, 110.0};
  return dish;
}

// |c + z d| = (z + 10) / 0.4, with the line's place relative to the axis at height 0 c.
double height_on_cone_mm(const InnerSurface& dish, const Sight& sight) {
  const Vec2 c = sight.at(0.0) - dish.place.centre_mm;
  const Vec2 d = -sight.run_per_mm;
  const double a = 6.25 - d.squaredNorm();
  const double b = 62.5 - c.dot(d);
  const double z = (-b + std::sqrt(b * b - a * (625.0 - c.squaredNorm()))) / a;
  return std::max(z, 6.0);
}

// The first height on the line, from the crest's down, that is at most so much over the dish.
double march_mm(const InnerSurface& dish, const Sight& sight, double over_mm) {
  constexpr double kStepMm = 0.01;
  double z_mm = dish.profile.crest_height_mm();
  while (z_mm > dish.profile.bottom_height_mm() && z_mm > dish.height_mm(sight.at(z_mm)) + over_mm)
    z_mm -= kStepMm;
  return z_mm;
}

TEST(KnownDish, FlatBottomsAreMetAtTheirHeight) {
  const InnerSurface flat = flat_dish(7.25);
  RandomSights sights(flat);
  for (int i = 0; i < kRays; ++i) {
    const Sight sight = sights.next();
    EXPECT_EQ(settled_height_mm(flat, sight.eye_mm, sight.run_per_mm), 7.25);
  }
}

TEST(KnownDish, ConicalWallsAreMetWhereTheQuadraticSays) {
  const InnerSurface cone = conical_dish();
  RandomSights sights(cone);
  int on_wall = 0;
  double worst_mm = 0.0;
  for (int i = 0; i < kRays; ++i) {
    const Sight sight = sights.next();
    const double expected_mm = height_on_cone_mm(cone, sight);
    ASSERT_NEAR(expected_mm, cone.height_mm(sight.at(expected_mm)), 1e-9);
    const double error_mm = std::abs(settled_height_mm(cone, sight.eye_mm, sight.run_per_mm) - expected_mm);
    worst_mm = std::max(worst_mm, error_mm);
    on_wall += expected_mm > 6.0 ? 1 : 0;
  }
  std::printf("%d on the wall, worst %.4f mm\n", on_wall, worst_mm);
  EXPECT_GT(on_wall, kRays / 2);
  EXPECT_LT(worst_mm, 0.04);
}

struct NamedDish {
  const char* name;
  InnerSurface dish;
};

class KnownDishes : public ::testing::TestWithParam<NamedDish> {};
INSTANTIATE_TEST_SUITE_P(All, KnownDishes,
                         ::testing::Values(NamedDish{"Dinner", test::dinner_plate()},
                                           NamedDish{"Bowl", test::soup_bowl()},
                                           NamedDish{"Oval", test::oval_plate()}),
                         [](const auto& dish) { return dish.param.name; });

// Also where the line goes on through the near wall and out of it again, unless it clips a crest. Along a
// wall the tolerance of the height leaves more of the line.
TEST_P(KnownDishes, AreMetWhereMarchingMeetsThemFirst) {
  constexpr double kClipMm = 0.5;
  const InnerSurface& dish = GetParam().dish;
  RandomSights sights(dish);
  int close = 0;
  for (int i = 0; i < kRays; ++i) {
    const Sight sight = sights.next();
    const double found_mm = settled_height_mm(dish, sight.eye_mm, sight.run_per_mm);
    EXPECT_NEAR(found_mm, dish.height_mm(sight.at(found_mm)), kToleranceMm) << "ray " << i;
    EXPECT_LE(found_mm, march_mm(dish, sight, kToleranceMm) + 0.02) << "ray " << i;
    EXPECT_GE(found_mm, march_mm(dish, sight, -kClipMm) - 0.02) << "ray " << i;
    close += std::abs(found_mm - march_mm(dish, sight, 0.0)) < 0.06 ? 1 : 0;
  }
  std::printf("within 0.06 mm: %.2f %%\n", 100.0 * close / kRays);
  EXPECT_GT(close, 0.99 * kRays);
}

// What the ray caster sees of a plate with food, its depths spoiled.
class SettledSamples : public ::testing::Test {
 protected:
  SettledSamples() {
    scene_.dish = test::soup_bowl();
    const Vec2& c = scene_.dish.place.centre_mm;
    scene_.solids = {test::heap(2, c + Vec2(10, -5), {30, 36}, 5, 30, 4, 9, 2)};
    test::SceneNoise noise;
    noise.depth_mm = 3.0;
    noise.seed = 11;
    truth_ = test::cast_grid(scene_, camera_, {}, 8192);
    noisy_ = test::cast_grid(scene_, camera_, noise, 8192);
    std::fill(noisy_.evidence.begin(), noisy_.evidence.end(), SurfaceEvidence::single);
    settled_ = noisy_;
    project_onto_dish(scene_.dish, noisy_.view(), settled_.points, settled_.evidence);
  }

  static Vec3 at(const test::TrueGrid& grid, std::size_t k) {
    const SurfacePoint& point = grid.points[k];
    return {point.x_mm, point.y_mm, point.z_mm};
  }

  test::SolidScene scene_;
  test::SceneCamera camera_{480, 30, 140};
  test::TrueGrid truth_;
  test::TrueGrid noisy_;
  test::TrueGrid settled_;
};

TEST_F(SettledSamples, OfTheDishReturnToWhereTheyWereCast) {
  int samples = 0;
  std::vector<double> errors_mm;
  for (std::size_t k = 0; k < settled_.count(); ++k) {
    if (settled_.labels[k] != kDishLabel) continue;
    errors_mm.push_back((at(settled_, k) - at(truth_, k)).norm());
    EXPECT_EQ(settled_.evidence[k], SurfaceEvidence::both);
    const Vec3 before = (at(noisy_, k) - noisy_.camera_mm).normalized();
    const Vec3 after = (at(settled_, k) - settled_.camera_mm).normalized();
    EXPECT_LT(before.cross(after).norm(), 1e-6) << "off its line of sight";
    ++samples;
  }
  EXPECT_GT(samples, 3000);
  std::sort(errors_mm.begin(), errors_mm.end());
  std::printf("%d samples, median %.4f mm, worst %.3f mm\n", samples, errors_mm[errors_mm.size() / 2],
              errors_mm.back());
  EXPECT_LT(errors_mm[errors_mm.size() / 2], kToleranceMm);
  EXPECT_LT(errors_mm[errors_mm.size() * 99 / 100], 0.05);
}

TEST_F(SettledSamples, OfItemsAndBeyondTheDishStayAsTheyAre) {
  int items = 0;
  for (std::size_t k = 0; k < settled_.count(); ++k) {
    EXPECT_EQ(settled_.labels[k], noisy_.labels[k]);
    if (settled_.labels[k] == kDishLabel) continue;
    EXPECT_EQ(at(settled_, k), at(noisy_, k));
    EXPECT_EQ(settled_.evidence[k], SurfaceEvidence::single);
    items += settled_.labels[k] == 2 ? 1 : 0;
  }
  EXPECT_GT(items, 1000);
}

// Nothing lies on a line that does not fall.
TEST_F(SettledSamples, LevelWithTheCameraStayAsTheyAre) {
  const auto dish = std::find(settled_.labels.begin(), settled_.labels.end(), kDishLabel);
  const auto k = static_cast<std::size_t>(dish - settled_.labels.begin());
  noisy_.points[k].z_mm = static_cast<float>(noisy_.camera_mm.z() + 1.0);
  settled_ = noisy_;
  project_onto_dish(scene_.dish, noisy_.view(), settled_.points, settled_.evidence);
  EXPECT_EQ(at(settled_, k), at(noisy_, k));
}

TEST(MatchedShare, CountsTheSamplesOfAllViews) {
  using enum SurfaceEvidence;
  const std::vector<std::uint8_t> labels{2, 2, 2, 2, 3, 0};
  const std::vector<SurfaceEvidence> first{both, single, filled, none, filled, none};
  const std::vector<SurfaceEvidence> second{both, both, both, both, filled, none};
  std::array<SurfaceGrid, 2> views;
  for (SurfaceGrid& view : views) view.labels = {labels.data(), 6, 1};
  views[0].evidence = {first.data(), 6, 1};
  views[1].evidence = {second.data(), 6, 1};
  const std::array<double, 256> shares = matched_fractions(views);
  EXPECT_DOUBLE_EQ(shares[2], 0.75);
  EXPECT_DOUBLE_EQ(shares[3], 0.0);
  EXPECT_DOUBLE_EQ(shares[4], 1.0) << "a label without samples";
}

}  // namespace
}  // namespace traygauge
