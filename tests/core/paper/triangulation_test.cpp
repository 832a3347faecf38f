#include "core/geometry/triangulation.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "core/paper/pose/epipolar.hpp"
#include "core/paper/pose/essential_decomposition.hpp"
#include "tests/core/paper/motion_scenes.hpp"

namespace traygauge::paper {
namespace {

TEST(Triangulation, ReturnsExactPoints) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const test::Scene scene = test::tray_scene(seed, {.matches = 50});
    for (std::size_t i = 0; i < scene.matches.size(); ++i) {
      Vec3 point;
      ASSERT_TRUE(triangulate(scene.matches[i], scene.second_from_first, point)) << "seed " << seed;
      EXPECT_LT((point - scene.points_in_first[i]).norm(), 1e-8) << "seed " << seed;
    }
  }
}

// cv::correctMatches solves Hartley and Sturm's sixth-degree polynomial: the true optimum.
TEST(Triangulation, CorrectsMatchesAsHartleyAndSturmDo) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const test::Scene scene = test::tray_scene(seed, {.matches = 30, .noise_px = 1.5});
    const Mat3 e = essential_matrix(scene.second_from_first).normalized();
    const cv::Matx33d f(e(0, 0), e(0, 1), e(0, 2), e(1, 0), e(1, 1), e(1, 2), e(2, 0), e(2, 1), e(2, 2));
    std::vector<cv::Point2d> first;
    std::vector<cv::Point2d> second;
    for (const RayMatch& match : scene.matches) {
      first.emplace_back(match.first.x(), match.first.y());
      second.emplace_back(match.second.x(), match.second.y());
    }
    cv::Mat first_corrected;
    cv::Mat second_corrected;
    cv::correctMatches(f, first, second, first_corrected, second_corrected);
    for (int i = 0; i < static_cast<int>(first.size()); ++i) {
      const RayMatch& match = scene.matches[static_cast<std::size_t>(i)];
      const RayMatch ours = correct_match(match, scene.second_from_first);
      const auto a = first_corrected.at<cv::Point2d>(0, i);
      const auto b = second_corrected.at<cv::Point2d>(0, i);
      EXPECT_LT(symmetric_epipolar_distance_px(e, ours, test::kFocalPx), 1e-4) << "seed " << seed;
      const double moved = std::hypot((ours.first - match.first).norm(), (ours.second - match.second).norm());
      const double optimal =
          std::hypot((Vec2(a.x, a.y) - match.first).norm(), (Vec2(b.x, b.y) - match.second).norm());
      EXPECT_NEAR(moved, optimal, 1e-3 / test::kFocalPx) << "seed " << seed;
    }
  }
}

TEST(Triangulation, RefusesPointsBehindACameraAndParallelRays) {
  const Pose motion{Mat3::Identity(), Vec3(-1.0, 0.0, 0.0)};
  Vec3 point;
  EXPECT_TRUE(triangulate({{0.1, 0.0}, {0.0, 0.0}}, motion, point));
  EXPECT_NEAR(point.z(), 10.0, 1e-12);
  EXPECT_FALSE(triangulate({{0.0, 0.0}, {0.1, 0.0}}, motion, point));  // rays part ways
  EXPECT_FALSE(triangulate({{0.1, 0.2}, {0.1, 0.2}}, motion, point));  // parallel
  // In front of the first camera, behind the second, which has moved past the point.
  const Pose past{Mat3::Identity(), Vec3(-0.2, 0.0, -5.0)};
  const Vec3 hidden(0.5, 0.1, 2.0);
  EXPECT_FALSE(triangulate(test::project(hidden, past), past, point));
}

TEST(Triangulation, TheCloudLeavesOutliersOut) {
  test::Scene scene = test::tray_scene(1, {.matches = 20});
  std::swap(scene.matches[3].first, scene.matches[3].second);
  std::vector<std::uint8_t> inliers(20, 1);
  inliers[5] = 0;
  std::vector<Vec3> points(20, Vec3::Zero());
  std::vector<std::uint8_t> triangulated(20, 9);
  triangulate_all(scene.matches, inliers, scene.second_from_first, points, triangulated);
  for (std::size_t i = 0; i < 20; ++i) {
    if (i == 3) continue;
    EXPECT_EQ(triangulated[i], i == 5 ? 0 : 1);
    if (i == 5) continue;
    EXPECT_LT((points[i] - scene.points_in_first[i]).norm(), 1e-8);
  }
}

TEST(EssentialDecomposition, HoldsTheTruthAndThreeOthersOfTheSameMatrix) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    const Pose truth = test::random_motion(random, 3.1);
    const Mat3 e = essential_matrix(truth);
    const double scale = seed % 2 == 0 ? -3.0 : 0.01;
    int hits = 0;
    for (const Pose& motion : decompose_essential(scale * e)) {
      EXPECT_NEAR(motion.rotation.determinant(), 1.0, 1e-12) << "seed " << seed;
      EXPECT_NEAR(motion.translation.norm(), 1.0, 1e-12) << "seed " << seed;
      const Mat3 back = essential_matrix(motion);
      EXPECT_LT(std::min((back - e).norm(), (back + e).norm()), 1e-9) << "seed " << seed;
      const bool is_truth = (motion.rotation - truth.rotation).norm() < 1e-9 &&
                            (motion.translation - truth.translation).norm() < 1e-9;
      hits += is_truth ? 1 : 0;
    }
    EXPECT_EQ(hits, 1) << "seed " << seed;
  }
}

TEST(Epipolar, DistanceIsThatOfThePointsToTheirLines) {
  const test::Scene scene = test::tray_scene(2, {.matches = 30, .noise_px = 3.0});
  const Mat3 e = essential_matrix(scene.second_from_first);
  for (const RayMatch& match : scene.matches) {
    // In pixels, through OpenCV's lines, which come with unit normals.
    const double f = test::kFocalPx;
    const Eigen::DiagonalMatrix<double, 3> to_ray(1.0 / f, 1.0 / f, 1.0);
    const Mat3 fundamental = to_ray * e * to_ray;
    cv::Matx33d m;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = fundamental(i / 3, i % 3);
    const std::vector<cv::Point2d> first = {{f * match.first.x(), f * match.first.y()}};
    const std::vector<cv::Point2d> second = {{f * match.second.x(), f * match.second.y()}};
    std::vector<cv::Vec3d> lines_in_second;
    std::vector<cv::Vec3d> lines_in_first;
    cv::computeCorrespondEpilines(first, 1, m, lines_in_second);
    cv::computeCorrespondEpilines(second, 2, m, lines_in_first);
    const double d2 = lines_in_second[0].dot(cv::Vec3d(second[0].x, second[0].y, 1.0));
    const double d1 = lines_in_first[0].dot(cv::Vec3d(first[0].x, first[0].y, 1.0));
    EXPECT_NEAR(symmetric_epipolar_distance_px(e, match, f), std::sqrt(0.5 * (d1 * d1 + d2 * d2)), 1e-6);
  }
}

TEST(MatchTable, ScoresAsTheFormulasSay) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const test::Scene scene = test::tray_scene(
        seed, {.matches = 131 + static_cast<int>(seed), .noise_px = 1.0, .outlier_fraction = 0.3});
    test::Estimation estimation;
    for (const RayMatch& match : scene.matches) estimation.workspace.matches.push_back(match);
    const Mat3 e = essential_matrix(scene.second_from_first);
    std::size_t count = 0;
    for (const RayMatch& match : scene.matches) {
      count += symmetric_epipolar_distance_px(e, match, test::kFocalPx) <= 1.5 ? 1U : 0U;
    }
    const double fitness = test::inlier_fitness(e, scene.matches, test::kFocalPx, 1.5);
    const MatchTable& table = estimation.workspace.matches;
    EXPECT_EQ(table.count_inliers(e, test::kFocalPx, 1.5, 0), count) << "seed " << seed;
    EXPECT_EQ(table.count_inliers(e, test::kFocalPx, 1.5, count - 1), count) << "seed " << seed;
    EXPECT_LE(table.count_inliers(e, test::kFocalPx, 1.5, count), count) << "seed " << seed;
    EXPECT_NEAR(table.fitness(e, test::kFocalPx, 1.5, -1.0), fitness, 1e-9 * fitness) << "seed " << seed;
    EXPECT_NEAR(table.fitness(e, test::kFocalPx, 1.5, 0.99 * fitness), fitness, 1e-9 * fitness);
    EXPECT_LE(table.fitness(e, test::kFocalPx, 1.5, 1.01 * fitness), 1.01 * fitness) << "seed " << seed;
  }
}

}  // namespace
}  // namespace traygauge::paper
