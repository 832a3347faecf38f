// How far rays pass by a rim: against OpenCV's distance to the projected outline, derivatives against
// differences.
#include "core/dish/rim_residual.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "tests/core/dish/edge_outlines.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

DishPose random_place(std::mt19937& random, double drop_mm) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  DishPose place;
  place.centre_mm = 60.0 * Vec2(unit(random), unit(random));
  place.azimuth_rad = 3.0 * unit(random);
  place.edge_height_mm = 25.0 + 15.0 * unit(random);
  place.size_mm = {220.0 + 60.0 * unit(random), 180.0 + 40.0 * unit(random)};
  place.edge_drop_mm = drop_mm;
  return place;
}

Pose random_camera(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  return test::camera_at(5.0 + 35.0 * unit(random), 360.0 * unit(random));
}

// Without a drop the outline is an ellipse in space, whose projection is a polygon of many sides.
TEST(RimResidual, IsTheDistanceInThePicture) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<std::size_t> any(0, 1999);
  std::uniform_real_distribution<double> off(-3.0, 3.0);
  for (int round = 0; round < 20; ++round) {
    const DishPose place = random_place(random, 0.0);
    const Pose camera = random_camera(random);
    const std::vector<Vec2> rays = test::outline_of(place, camera, 2000);
    std::vector<cv::Point2f> polygon;
    for (const Vec2& ray : rays) {
      const Vec2 pixel = test::kOutlineFocalPx * ray;
      polygon.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
    }
    const RimProjection rim(place, camera, test::kOutlineFocalPx);
    for (int i = 0; i < 50; ++i) {
      const Vec2 ray = rays[any(random)] + Vec2(off(random), off(random)) / test::kOutlineFocalPx;
      const Vec2 pixel = test::kOutlineFocalPx * ray;
      const double inside_px =
          cv::pointPolygonTest(polygon, {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())}, true);
      double residual_px = 0.0;
      ASSERT_TRUE(rim.residual(ray, residual_px));
      EXPECT_NEAR(residual_px, -inside_px, 0.02 + 0.03 * std::abs(inside_px));
    }
  }
}

// Seen from outside, on the near side, the outline is the lower end of the upright side.
TEST(RimResidual, VanishesOnAnEdgeThatDropsOnTheNearSide) {
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 20; ++round) {
    const DishPose place = random_place(random, 3.0);
    const Pose camera = random_camera(random);
    const RimProjection rim(place, camera, test::kOutlineFocalPx);
    DishPose flat = place;
    flat.edge_drop_mm = 0.0;
    const RimProjection without(flat, camera, test::kOutlineFocalPx);
    double most_px = 0.0;
    double most_without_px = 0.0;
    for (const Vec2& ray : test::outline_of(place, camera)) {
      double residual_px = 0.0;
      ASSERT_TRUE(rim.residual(ray, residual_px));
      most_px = std::max(most_px, std::abs(residual_px));
      ASSERT_TRUE(without.residual(ray, residual_px));
      most_without_px = std::max(most_without_px, std::abs(residual_px));
    }
    EXPECT_LT(most_px, 0.5);
    if (most_without_px > 1.0) {
      EXPECT_LT(most_px, 0.2 * most_without_px);
    }
  }
}

TEST(RimResidual, DerivativesAreWhatDifferencesSay) {
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 20; ++round) {
    // How a step changes from which side the edge is seen is left out: little, beside the rest.
    const double drop_mm = round % 2 == 0 ? 0.0 : 1.0;
    const double step_tolerance = drop_mm > 0.0 ? 0.25 : 0.001;
    const DishPose place = random_place(random, drop_mm);
    const Pose camera = random_camera(random);
    const std::vector<Vec2> rays = test::outline_of(place, camera, 24);
    for (const Vec2& ray : rays) {
      double here_px = 0.0;
      Eigen::Matrix<double, 6, 1> by_camera;
      PlaceVector by_place;
      const RimProjection rim(place, camera, test::kOutlineFocalPx);
      ASSERT_TRUE(rim.linearise(ray, here_px, by_camera, by_place));
      double same_px = 0.0;
      ASSERT_TRUE(rim.residual(ray, same_px));
      EXPECT_EQ(here_px, same_px);
      const auto slope = [&](const auto& projection_at, double step) {
        double above = 0.0;
        double below = 0.0;
        EXPECT_TRUE(projection_at(step).residual(ray, above));
        EXPECT_TRUE(projection_at(-step).residual(ray, below));
        return (above - below) / (2.0 * step);
      };
      for (int i = 0; i < 6; ++i) {
        const double step = i < 3 ? 1e-6 : 1e-4;
        const double expected = slope(
            [&](double size) {
              return RimProjection(place, moved(camera, size * Eigen::Matrix<double, 6, 1>::Unit(i)),
                                   test::kOutlineFocalPx);
            },
            step);
        EXPECT_NEAR(by_camera[i], expected, step_tolerance * by_camera.lpNorm<Eigen::Infinity>()) << i;
      }
      for (int i = 0; i < kPlaceParameters; ++i) {
        const double step = i == kPlaceAzimuth ? 1e-6 : 1e-4;
        const double expected = slope(
            [&](double size) {
              return RimProjection(place_from_vector(as_vector(place) + size * PlaceVector::Unit(i)), camera,
                                   test::kOutlineFocalPx);
            },
            step);
        const double size = i == kPlaceAzimuth ? 100.0 : 1.0;
        EXPECT_NEAR(by_place[i], expected, step_tolerance * (size + std::abs(expected))) << i;
      }
    }
  }
}

TEST(RimResidual, IsUnknownWhereARayDoesNotComeDown) {
  std::mt19937 random(5);
  const RimProjection rim(random_place(random, 1.0), test::camera_at(20.0, 0.0), test::kOutlineFocalPx);
  double residual_px = 0.0;
  EXPECT_TRUE(rim.residual(Vec2(0.1, 0.0), residual_px));
  const Pose level{test::camera_at(88.0, 0.0).rotation, Vec3(0.0, 0.0, 500.0)};
  EXPECT_FALSE(RimProjection(random_place(random, 1.0), level, test::kOutlineFocalPx)
                   .residual(Vec2(0.0, -0.5), residual_px));
  // The centre has no outward direction.
  DishPose centred = random_place(random, 1.0);
  centred.centre_mm = Vec2::Zero();
  centred.edge_height_mm = 0.0;
  EXPECT_FALSE(RimProjection(centred, test::camera_at(20.0, 0.0), test::kOutlineFocalPx)
                   .residual(Vec2::Zero(), residual_px));
}

}  // namespace
}  // namespace traygauge
