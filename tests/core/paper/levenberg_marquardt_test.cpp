#include "core/geometry/levenberg_marquardt.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/paper/pose/pose_refinement.hpp"
#include "tests/core/paper/motion_scenes.hpp"

namespace traygauge::paper {
namespace {

// Rosenbrock's valley as two residuals: 10 (y − x²) and 1 − x.
struct Rosenbrock {
  using Vector = NormalEquations<2>::Vector;
  double cost(const Vector& p) const {
    const double a = 10.0 * (p[1] - p[0] * p[0]);
    const double b = 1.0 - p[0];
    return a * a + b * b;
  }
  double linearise(const Vector& p, NormalEquations<2>& equations) const {
    equations.add(10.0 * (p[1] - p[0] * p[0]), Vector(-20.0 * p[0], 10.0));
    equations.add(1.0 - p[0], Vector(-1.0, 0.0));
    return cost(p);
  }
  Vector moved(const Vector& p, const Vector& step) const { return p + step; }
};

TEST(LevenbergMarquardt, FollowsRosenbrocksValley) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Rosenbrock::Vector p(test::uniform(random, -2, 2), test::uniform(random, -2, 2));
    LevenbergMarquardtParams params;
    params.max_iterations = 200;
    const auto report = minimise<2>(Rosenbrock{}, params, p);
    EXPECT_LT((p - Rosenbrock::Vector(1.0, 1.0)).norm(), 1e-6) << "seed " << seed;
    EXPECT_LE(report.cost, report.initial_cost);
  }
}

TEST(LevenbergMarquardt, StopsAtItsBound) {
  Rosenbrock::Vector p(-1.2, 1.0);
  LevenbergMarquardtParams params;
  params.max_iterations = 3;
  const auto report = minimise<2>(Rosenbrock{}, params, p);
  EXPECT_EQ(report.iterations, 3);
  EXPECT_FALSE(report.converged);
  EXPECT_LE(report.cost, report.initial_cost);
}

TEST(NormalEquations, SolvesWhatEigenSolves) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    NormalEquations<5> equations;
    Eigen::Matrix<double, 5, 5> full = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 5, 1> gradient = Eigen::Matrix<double, 5, 1>::Zero();
    for (int i = 0; i < 12; ++i) {
      NormalEquations<5>::Vector j;
      for (int k = 0; k < 5; ++k) j[k] = test::uniform(random, -1, 1);
      const double residual = test::uniform(random, -1, 1);
      const double weight = test::uniform(random, 0.1, 2);
      equations.add(residual, j, weight);
      full += weight * j * j.transpose();
      gradient += weight * residual * j;
    }
    full.diagonal() *= 1.01;
    NormalEquations<5>::Vector step;
    ASSERT_TRUE(equations.solve(0.01, step));
    EXPECT_LT((full * step + gradient).norm(), 1e-10) << "seed " << seed;
  }
}

TEST(NormalEquations, RefusesASingularSystem) {
  NormalEquations<2> equations;
  equations.add(1.0, NormalEquations<2>::Vector(1.0, 0.0));
  NormalEquations<2>::Vector step;
  EXPECT_FALSE(equations.solve(0.1, step));
}

class EpipolarProblemTest : public ::testing::TestWithParam<double> {
 protected:
  void load(std::uint64_t seed) {
    test::TrayOptions options;
    options.matches = 40;
    options.noise_px = 2.0;
    scene_ = test::tray_scene(seed, options);
    scene_.second_from_first.translation.normalize();
    indices_.clear();
    for (const RayMatch& match : scene_.matches) {
      indices_.push_back(static_cast<std::uint32_t>(indices_.size()));
      estimation_.workspace.matches.push_back(match);
    }
  }
  test::Estimation estimation_;
  test::Scene scene_;
  std::vector<std::uint32_t> indices_;
};

TEST_P(EpipolarProblemTest, GradientIsTheNumericOne) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    estimation_.workspace.matches.clear();
    load(seed);
    const EpipolarProblem problem(estimation_.workspace.matches, indices_, test::kFocalPx, GetParam());
    EpipolarProblem::Equations equations;
    const double cost = problem.linearise(scene_.second_from_first, equations);
    EXPECT_NEAR(cost, problem.cost(scene_.second_from_first), 1e-9 * cost);
    for (int k = 0; k < kPoseParameters; ++k) {
      constexpr double kStep = 1e-7;
      EpipolarProblem::Equations::Vector step = EpipolarProblem::Equations::Vector::Zero();
      step[k] = kStep;
      const double up = problem.cost(problem.moved(scene_.second_from_first, step));
      step[k] = -kStep;
      const double down = problem.cost(problem.moved(scene_.second_from_first, step));
      const double numeric = (up - down) / (2.0 * kStep);
      EXPECT_NEAR(2.0 * equations.gradient[k], numeric, 1e-4 * (equations.gradient.norm() + 1.0))
          << "seed " << seed << " parameter " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, EpipolarProblemTest, ::testing::Values(1.0, 3.0, 1e6));

// One match, no robust loss: JᵀJ from the distances to the lines, differentiated numerically.
TEST_F(EpipolarProblemTest, NormalMatrixIsTheNumericOne) {
  load(5);
  const auto residuals = [&](const Pose& pose) {
    const Mat3 e = essential_matrix(pose);
    const Vec3 x1 = scene_.matches[0].first.homogeneous();
    const Vec3 x2 = scene_.matches[0].second.homogeneous();
    const double c = x2.dot(e * x1) * test::kFocalPx / std::sqrt(2.0);
    return Vec2(c / (e * x1).head<2>().norm(), c / (e.transpose() * x2).head<2>().norm());
  };
  const EpipolarProblem problem(estimation_.workspace.matches, std::span(indices_).first(1), test::kFocalPx,
                                1e9);
  EpipolarProblem::Equations equations;
  problem.linearise(scene_.second_from_first, equations);
  Eigen::Matrix<double, 2, kPoseParameters> jacobian;
  for (int k = 0; k < kPoseParameters; ++k) {
    EpipolarProblem::Equations::Vector step = EpipolarProblem::Equations::Vector::Zero();
    step[k] = 1e-6;
    const Vec2 up = residuals(problem.moved(scene_.second_from_first, step));
    const Vec2 down = residuals(problem.moved(scene_.second_from_first, -step));
    jacobian.col(k) = (up - down) / 2e-6;
  }
  const Eigen::Matrix<double, 5, 5> expected = jacobian.transpose() * jacobian;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j <= i; ++j) {
      EXPECT_NEAR(equations.hessian(i, j), expected(i, j), 1e-5 * expected.norm());
    }
  }
}

}  // namespace
}  // namespace traygauge::paper
