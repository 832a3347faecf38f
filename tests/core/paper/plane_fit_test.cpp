#include "core/paper/base/plane_fit.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace traygauge::paper {
namespace {

Plane random_plane(std::mt19937& generator) {
  std::normal_distribution<double> normal;
  Vec3 direction(0.5 * normal(generator), 0.5 * normal(generator), -1.0);
  return {direction.normalized(), -400.0};
}

std::vector<Vec3> points_on(const Plane& plane, int count, double sigma_mm, std::mt19937& generator) {
  std::normal_distribution<double> normal(0.0, 1.0);
  const Vec3 u = plane.normal.cross(Vec3::UnitX()).normalized();
  const Vec3 v = plane.normal.cross(u);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(plane.normal * (plane.offset + sigma_mm * normal(generator)) +
                        80.0 * normal(generator) * u + 80.0 * normal(generator) * v);
  }
  return points;
}

TEST(PlaneFit, LeastSquaresIsExactOnAPlaneAndFacesTheCamera) {
  std::mt19937 generator(1);
  for (int round = 0; round < 20; ++round) {
    const Plane truth = random_plane(generator);
    Plane plane;
    ASSERT_TRUE(fit_plane_least_squares(points_on(truth, 40, 0.0, generator), plane));
    EXPECT_LT((plane.normal - truth.normal).norm(), 1e-9) << "round " << round;
    EXPECT_NEAR(plane.offset, truth.offset, 1e-7);
    EXPECT_GT(plane.height(Vec3::Zero()), 0.0);
  }
}

TEST(PlaneFit, WithstandsFortyPercentOutliers) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 generator(static_cast<unsigned>(seed));
    const Plane truth = random_plane(generator);
    std::vector<Vec3> points = points_on(truth, 240, 0.3, generator);
    std::uniform_real_distribution<double> wild(-60.0, 60.0);
    for (int i = 0; i < 160; ++i) {
      points.push_back(points[static_cast<std::size_t>(i)] + wild(generator) * truth.normal);
    }
    Random random(seed);
    PlaneFit fit;
    ASSERT_TRUE(fit_plane(points, {}, random, fit));
    EXPECT_LT(fit.plane.normal.cross(truth.normal).norm(), 0.002);
    EXPECT_NEAR(fit.plane.offset, truth.offset, 0.3);
    EXPECT_GE(fit.inliers, 238);
    EXPECT_LE(fit.inliers, 260);
    for (int i = 0; i < fit.inliers; ++i) {
      EXPECT_LT(std::abs(fit.plane.height(points[static_cast<std::size_t>(i)])),
                PlaneFitParams().threshold_mm);
    }
  }
}

TEST(PlaneFit, TheSameSeedGivesTheSameBits) {
  std::mt19937 generator(5);
  const std::vector<Vec3> points = points_on(random_plane(generator), 100, 1.0, generator);
  PlaneFit first;
  PlaneFit second;
  for (PlaneFit* fit : {&first, &second}) {
    std::vector<Vec3> copy = points;
    Random random(9);
    ASSERT_TRUE(fit_plane(copy, {}, random, *fit));
  }
  EXPECT_EQ(first.plane.normal, second.plane.normal);
  EXPECT_EQ(first.plane.offset, second.plane.offset);
}

TEST(PlaneFit, RefusesLinesAndTooFewPoints) {
  std::vector<Vec3> line;
  for (int i = 0; i < 50; ++i) line.emplace_back(i, 2.0 * i, 400.0);
  Plane plane;
  EXPECT_FALSE(fit_plane_least_squares(line, plane));
  Random random(1);
  PlaneFit fit;
  EXPECT_FALSE(fit_plane(line, {}, random, fit));
  std::vector<Vec3> few{{0, 0, 400}, {50, 0, 400}, {0, 50, 400}, {50, 50, 400}};
  EXPECT_FALSE(fit_plane(few, {}, random, fit));
  EXPECT_FALSE(fit_plane(std::span<Vec3>(), {}, random, fit));
}

}  // namespace
}  // namespace traygauge::paper
