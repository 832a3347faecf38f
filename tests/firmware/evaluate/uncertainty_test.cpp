// Coverage and sharpness of sigma, by hand and for errors of known distribution.
#include "firmware/evaluate/uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "tests/firmware/evaluate/sample_runs.hpp"

namespace traygauge {
namespace {

double draw_normal(Random& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
}

TEST(Uncertainty, OfVolumesWorkedOutByHand) {
  // Errors over sigma: 0, 2 (the limit counts), 2.5, 1, 5, 1.
  const SigmaFigures figures =
      sigma_figures({series("a", 100.0, {measured(0, 100.0, 1.0), measured(0, 104.0, 2.0), refused(0)}),
                     series("b", 200.0, {measured(1, 190.0, 4.0), measured(1, 205.0, 5.0)}),
                     series("c", 400.0, {measured(2, 430.0, 6.0), measured(2, 408.0, 8.0)})});
  EXPECT_TRUE(figures.is_estimated);
  EXPECT_EQ(figures.estimates, 6);
  EXPECT_EQ(figures.without_sigma, 0);
  EXPECT_NEAR(figures.coverage, 400.0 / 6.0, 1e-12);
  EXPECT_EQ(figures.coverage_by_thirds, (std::array{100.0, 50.0, 50.0}));
  // sigma / volume in per cent: 1, 1.92, 2.11, 2.44, 1.40, 1.96
  EXPECT_EQ(figures.coverage_by_relative_thirds, (std::array{50.0, 100.0, 50.0}));
  EXPECT_NEAR(figures.median_relative_sigma, 50.0 * (2.0 / 104.0 + 8.0 / 408.0), 1e-12);
  // Ranks of the errors 0, 4, 10, 5, 30, 8: 1, 2, 5, 3, 6, 4.
  EXPECT_NEAR(figures.rank_correlation, 1.0 - 6.0 * (4.0 + 1.0 + 1.0 + 4.0) / (6.0 * 35.0), 1e-12);
}

TEST(Uncertainty, AVolumeWithoutSigmaIsNotCovered) {
  const SigmaFigures figures =
      sigma_figures({series("a", 100.0, {measured(0, 100.0, 1.0), measured(0, 100.0)})});
  EXPECT_TRUE(figures.is_estimated);
  EXPECT_EQ(figures.without_sigma, 1);
  EXPECT_NEAR(figures.coverage, 50.0, 1e-12);
}

TEST(Uncertainty, NotEstimatedIsSaid) {
  EXPECT_FALSE(sigma_figures({}).is_estimated);
  EXPECT_FALSE(sigma_figures({series("a", 100.0, {measured(0, 100.0), refused(0)})}).is_estimated);
}

TEST(Uncertainty, NormalErrorsAreCoveredAsTheNormalDistributionSays) {
  constexpr int volumes = 9000;
  constexpr double normal_coverage = 95.45;
  constexpr double scipy_rank_correlation = 0.3738;  // |N(0, s)| against s uniform in 1 to 4, 2 million draws
  Random random(3);
  ItemSeries item = series("a", 1000.0, {});
  for (int i = 0; i < volumes; ++i) {
    const double sigma = 1.0 + 3.0 * random.uniform();
    item.attempts.push_back(measured(i, 1000.0 + sigma * draw_normal(random), sigma));
  }
  const SigmaFigures figures = sigma_figures({item});
  const double deviation = 100.0 * std::sqrt(0.9545 * 0.0455 / volumes);
  EXPECT_NEAR(figures.coverage, normal_coverage, 4.0 * deviation);
  for (const double third : figures.coverage_by_thirds)
    EXPECT_NEAR(third, normal_coverage, 4.0 * std::sqrt(3.0) * deviation);
  EXPECT_NEAR(figures.rank_correlation, scipy_rank_correlation, 4.0 / std::sqrt(volumes));
  EXPECT_NEAR(figures.median_relative_sigma, 0.25, 0.01);
}

}  // namespace
}  // namespace traygauge
