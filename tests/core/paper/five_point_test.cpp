#include "core/paper/pose/five_point.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "core/paper/pose/polynomial_roots.hpp"
#include "tests/core/paper/motion_scenes.hpp"

namespace traygauge::paper {
namespace {

using test::uniform;

enum class Shape { general, planar, sideways, forward, sideways_without_rotation, forward_without_rotation };

struct Sample {
  Pose motion;
  std::vector<RayMatch> matches;
};

Sample draw_sample(Shape shape, std::uint64_t seed, std::size_t size) {
  Random random(seed);
  Sample sample;
  sample.motion = test::random_motion(random, 0.6);
  if (shape == Shape::sideways || shape == Shape::sideways_without_rotation) {
    sample.motion.translation = Vec3::UnitX();
  }
  if (shape == Shape::forward || shape == Shape::forward_without_rotation) {
    sample.motion.translation = Vec3::UnitZ();
  }
  if (shape >= Shape::sideways_without_rotation) sample.motion.rotation = Mat3::Identity();
  while (sample.matches.size() < size) {
    const double depth = shape == Shape::planar ? 6.0 : uniform(random, 3.0, 7.0);
    Vec3 point(uniform(random, -0.5, 0.5) * depth, uniform(random, -0.5, 0.5) * depth, depth);
    if (shape == Shape::planar) point.z() += 0.3 * point.x();
    sample.matches.push_back(test::project(point, sample.motion));
  }
  return sample;
}

double distance_up_to_sign(const Mat3& a, const Mat3& b) {
  return std::min((a - b).norm(), (a + b).norm());
}

double nearest(const Mat3& truth, const std::array<Mat3, kMaxEssentials>& essentials, int count) {
  double best = 2.0;
  for (int i = 0; i < count; ++i) {
    best = std::min(best, distance_up_to_sign(essentials[static_cast<std::size_t>(i)], truth));
  }
  return best;
}

class FivePoint : public ::testing::TestWithParam<Shape> {};

TEST_P(FivePoint, FindsTheTrueEssentialMatrixOfExactScenes) {
  constexpr int kScenes = 5000;
  int missed = 0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Sample sample = draw_sample(GetParam(), seed, 5);
    std::array<Mat3, kMaxEssentials> essentials;
    const int count = solve_five_point(sample.matches, essentials);
    const Mat3 truth = essential_matrix(sample.motion).normalized();
    missed += nearest(truth, essentials, count) < 1e-7 ? 0 : 1;
  }
  EXPECT_LE(missed, kScenes / 1000);
}

TEST_P(FivePoint, EverySolutionIsAnEssentialMatrixThatFitsTheMatches) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Sample sample = draw_sample(GetParam(), seed, 5);
    std::array<Mat3, kMaxEssentials> essentials;
    const int count = solve_five_point(sample.matches, essentials);
    for (int i = 0; i < count; ++i) {
      const Mat3& e = essentials[static_cast<std::size_t>(i)];
      const Mat3 gram = e * e.transpose();
      ASSERT_NEAR(e.norm(), 1.0, 1e-12) << "seed " << seed;
      ASSERT_NEAR(e.determinant(), 0.0, 1e-9) << "seed " << seed;
      ASSERT_LT((2.0 * gram * e - gram.trace() * e).norm(), 1e-9) << "seed " << seed;
      for (const RayMatch& match : sample.matches) {
        ASSERT_NEAR(match.second.homogeneous().dot(e * match.first.homogeneous()), 0.0, 1e-9)
            << "seed " << seed;
      }
    }
  }
}

TEST_P(FivePoint, TenMatchesAgreeOnTheTruth) {
  int missed = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Sample sample = draw_sample(GetParam(), seed, 10);
    std::array<Mat3, kMaxEssentials> essentials;
    const int count = solve_five_point(sample.matches, essentials);
    const Mat3 truth = essential_matrix(sample.motion).normalized();
    missed += nearest(truth, essentials, count) < 1e-6 ? 0 : 1;
  }
  EXPECT_LE(missed, 5);  // the normal matrix squares the condition of the matches
}

INSTANTIATE_TEST_SUITE_P(Shapes, FivePoint,
                         ::testing::Values(Shape::general, Shape::planar, Shape::sideways, Shape::forward,
                                           Shape::sideways_without_rotation,
                                           Shape::forward_without_rotation));

// OpenCV has a five-point solver of its own; from five matches it returns all solutions, stacked.
TEST(FivePointOracle, FindsWhatOpenCvFinds) {
  int solutions = 0;
  int missed = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Sample sample = draw_sample(Shape::general, seed, 5);
    std::vector<cv::Point2d> first;
    std::vector<cv::Point2d> second;
    for (const RayMatch& match : sample.matches) {
      first.emplace_back(match.first.x(), match.first.y());
      second.emplace_back(match.second.x(), match.second.y());
    }
    const cv::Mat stacked = cv::findEssentialMat(first, second, 1.0, cv::Point2d(0, 0));
    std::array<Mat3, kMaxEssentials> essentials;
    const int count = solve_five_point(sample.matches, essentials);
    for (int row = 0; row + 3 <= stacked.rows; row += 3) {
      Mat3 e;
      for (int i = 0; i < 9; ++i) e(i / 3, i % 3) = stacked.at<double>(row + i / 3, i % 3);
      ++solutions;
      missed += nearest(e.normalized(), essentials, count) < 1e-5 ? 0 : 1;
    }
  }
  EXPECT_GT(solutions, 1500);
  EXPECT_LE(missed, solutions / 500);
}

TEST(FivePointDegenerate, RepeatedOrTooFewMatchesDoNoHarm) {
  const Sample sample = draw_sample(Shape::general, 3, 5);
  std::array<Mat3, kMaxEssentials> essentials;
  EXPECT_EQ(solve_five_point(std::span(sample.matches).first(4), essentials), 0);
  const std::vector<RayMatch> repeated(5, sample.matches[0]);
  const int count = solve_five_point(repeated, essentials);
  ASSERT_GE(count, 0);
  ASSERT_LE(count, static_cast<int>(kMaxEssentials));
  for (int i = 0; i < count; ++i) EXPECT_TRUE(essentials[static_cast<std::size_t>(i)].allFinite());
}

TEST(PolynomialRoots, FindsTheRootsThatThePolynomialWasMadeFrom) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    const int real_roots = 2 * static_cast<int>(random.below(6));
    PolynomialCoefficients c{1.0};
    const auto multiply = [&](double a0, double a1, double a2) {
      PolynomialCoefficients product{};
      for (std::size_t k = 0; k < c.size(); ++k) {
        product[k] += a0 * c[k];
        if (k + 1 < c.size()) product[k + 1] += a1 * c[k];
        if (k + 2 < c.size()) product[k + 2] += a2 * c[k];
      }
      c = product;
    };
    std::vector<double> expected;
    for (int i = 0; i < real_roots; ++i) {  // at least 0.3 apart, some beyond ±1
      expected.push_back(-1.6 + 0.4 * i + uniform(random, -0.05, 0.05));
      multiply(-expected.back(), 1.0, 0.0);
    }
    for (int i = real_roots; i < kPolynomialDegree; i += 2) {  // complex pairs
      const double real = uniform(random, -2, 2);
      const double imaginary = uniform(random, 0.3, 2);
      multiply(real * real + imaginary * imaginary, -2.0 * real, 1.0);
    }
    std::array<double, kPolynomialDegree> roots{};
    const int count = find_real_roots(c, roots);
    ASSERT_EQ(count, real_roots) << "seed " << seed;
    std::vector<double> found(roots.begin(), roots.begin() + count);
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_NEAR(found[i], expected[i], 1e-6) << "seed " << seed;
  }
}

}  // namespace
}  // namespace traygauge::paper
