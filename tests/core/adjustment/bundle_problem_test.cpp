// The bundle problem's slopes against differences of its cost, its elimination against the whole system.
#include "core/adjustment/bundle_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/core/adjustment/bundle_scene.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

test::BundleSceneOptions sharp_outlines() {
  test::BundleSceneOptions options;
  options.outline_sigma_px = 0.1;
  return options;
}

// Tracks and rims that all count; the state lies a little off the truth.
struct ProblemScene {
  test::BundleScene scene;
  std::vector<TrackWeight> weights;
  std::vector<BundleRim> rims;
  std::array<PlaceElimination, 1> eliminations;
  BundleTerms terms;
  BundleState state;

  ProblemScene(std::uint64_t seed, bool has_rim) : scene(test::bundle_scene(seed, sharp_outlines())) {
    terms.cards = scene.cards;
    terms.card_pivot_mm = scene.card_middle_mm;
    terms.lie_tilt_information = 1e5;
    terms.lie_raised_information = 100.0;
    for (const PointTrack& track : scene.tracks) {
      const bool is_table = track.label == kBackgroundLabel;
      weights.push_back({0.01, 400.0, 0.04, 900.0, true, is_table});
    }
    terms.tracks = scene.tracks;
    terms.weights = weights;
    terms.focals_px = {test::kFocalPx, test::kFocalPx};
    if (has_rim) {
      BundleRim rim;
      rim.outlines = {scene.outlines[0], scene.outlines[1]};
      rim.prior = loose_prior(scene.place, 0.5, 0.5, {});
      rim.scale_px = 50.0;
      rims.push_back(rim);
      terms.rims = rims;
    }
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Vec6 step;
    for (std::size_t v = 0; v < 2; ++v) {
      for (int i = 0; i < 6; ++i) step[i] = normal(random) * (i < 3 ? 2e-4 : 0.1);
      state.camera_from_table[v] = moved(scene.camera_from_table[v], step);
    }
    state.card = {Vec2(1e-3, -5e-4), 0.1};
    state.places[0] = scene.place;
  }
  BundleProblem problem() { return {terms, eliminations}; }
};

// Half of the cost's slope is the gradient of the normal equations.
TEST(BundleProblem, GradientIsHalfTheSlopeOfTheCost) {
  const std::uint32_t seed = test::random_seed();
  for (std::uint64_t round = 0; round < 5; ++round) {
    ProblemScene scene(seed + round, false);
    const BundleProblem problem = scene.problem();
    BundleProblem::Equations equations;
    EXPECT_NEAR(problem.linearise(scene.state, equations), problem.cost(scene.state),
                1e-9 * problem.cost(scene.state));
    for (int i = 0; i < kBundleParameters; ++i) {
      const bool is_turn = i < 12 ? i % 6 < 3 : i < 14;
      const double size = is_turn ? 1e-7 : 1e-5;
      const double slope = (problem.cost(problem.moved(scene.state, size * BundleVector::Unit(i))) -
                            problem.cost(problem.moved(scene.state, -size * BundleVector::Unit(i)))) /
                           (2.0 * size);
      // In units of what a standard deviation of this parameter alone would cost: turns are taken for small,
      // and an epipolar line's own turn is left out.
      const double unit = std::sqrt(equations.hessian(i, i));
      const double tolerance =
          0.02 *
          equations.gradient.cwiseAbs().cwiseQuotient(equations.hessian.diagonal().cwiseSqrt()).maxCoeff();
      EXPECT_NEAR(equations.gradient[i] / unit, 0.5 * slope / unit, tolerance) << i;
    }
  }
}

// The places are left out and follow: minimised so, no step of theirs alone does better.
TEST(BundleProblem, DishesFollowToWhereTheyCostLeast) {
  const std::uint32_t seed = test::random_seed();
  for (std::uint64_t round = 0; round < 5; ++round) {
    ProblemScene scene(seed + round, true);
    const BundleProblem problem = scene.problem();
    BundleState state = scene.state;
    LevenbergMarquardtParams params;
    params.max_iterations = 30;
    const LevenbergMarquardtReport report = minimise<kBundleParameters>(problem, params, state);
    EXPECT_LT(report.cost, 0.98 * report.initial_cost);
    for (int i = 0; i < kPlaceParameters; ++i) {
      for (const double sign : {-1.0, 1.0}) {
        BundleState beside = state;
        const double size = i == kPlaceAzimuth ? 0.01 : 0.2;
        beside.places[0] = place_from_vector(as_vector(state.places[0]) + sign * size * PlaceVector::Unit(i));
        EXPECT_GT(problem.cost(beside), problem.cost(state) * (1.0 - 1e-9)) << i;
      }
    }
    EXPECT_LT((state.places[0].centre_mm - scene.scene.place.centre_mm).norm(), 0.5);
    // Where both cameras shift by 2 mm over the table the dish goes along, to where it costs least again.
    BundleProblem::Equations equations;
    problem.linearise(state, equations);
    BundleVector shift = BundleVector::Zero();
    for (int v = 0; v < 2; ++v)
      shift.segment<3>(6 * v + 3) =
          2.0 * state.camera_from_table[static_cast<std::size_t>(v)].rotation.col(0);
    const BundleState shifted = problem.moved(state, shift);
    EXPECT_LT((shifted.places[0].centre_mm - state.places[0].centre_mm - Vec2(-2.0, 0.0)).norm(), 0.1);
    for (std::size_t v = 0; v < 2; ++v)
      EXPECT_LT(test::rotation_error_deg(state.camera_from_table[v], scene.scene.camera_from_table[v]), 0.2);
  }
}

// A rim that a camera cannot see costs more than anything else, so that no step leads there.
TEST(BundleProblem, PlacesThatCannotBeSeenAreNoSolution) {
  ProblemScene scene(7, true);
  BundleState state = scene.state;
  state.places[0].edge_height_mm = 5000.0;
  EXPECT_GE(scene.problem().cost(state), 1e29);
  BundleProblem::Equations equations;
  EXPECT_GE(scene.problem().linearise(state, equations), 1e29);
}

TEST(BundleProblem, InverseIsThatOfEigensSolver) {
  std::mt19937 random(test::random_seed());
  std::normal_distribution<double> normal;
  for (int round = 0; round < 50; ++round) {
    Eigen::Matrix<double, 7, 7> root;
    for (int i = 0; i < 7; ++i) {
      for (int j = 0; j < 7; ++j) root(i, j) = normal(random);
    }
    const Eigen::Matrix<double, 7, 7> information =
        root * root.transpose() + 0.1 * Eigen::Matrix<double, 7, 7>::Identity();
    Eigen::Matrix<double, 7, 7> lower = information.triangularView<Eigen::Lower>();
    const Eigen::Matrix<double, 7, 7> product = inverse_information<7>(lower) * information;
    EXPECT_LT((product - Eigen::Matrix<double, 7, 7>::Identity()).norm(), 1e-8);
    lower(3, 3) = -1.0;
    EXPECT_EQ((inverse_information<7>(lower).norm()), 0.0);
  }
}

}  // namespace
}  // namespace traygauge
