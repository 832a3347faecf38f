// Intervals against scipy.stats.bootstrap (percentile), and how often they hold the truth.
#include "firmware/evaluate/bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.hpp"
#include "firmware/evaluate/accuracy.hpp"
#include "tests/firmware/evaluate/sample_runs.hpp"

namespace traygauge {
namespace {

const std::vector<RatioPart> kParts = {{3.2, 1.0}, {8.1, 3.0}, {5.5, 2.0}, {1.4, 1.0},
                                       {9.9, 3.0}, {4.2, 2.0}, {6.3, 2.0}, {2.8, 1.0}};

TEST(Bootstrap, AgreesWithScipy) {
  BootstrapParams params;
  params.resamples = 100000;
  const auto interval = bootstrap_ratio(kParts, params);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->low, 2.365, 0.01);  // 400000 resamples by numpy; 100000 by scipy: 2.367, 3.074
  EXPECT_NEAR(interval->high, 3.075, 0.01);
}

TEST(Bootstrap, TheSameSeedGivesTheSameInterval) {
  const auto first = bootstrap_ratio(kParts);
  const auto second = bootstrap_ratio(kParts);
  BootstrapParams other_seed;
  other_seed.seed = 2;
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->low, second->low);
  EXPECT_EQ(first->high, second->high);
  EXPECT_NE(first->low, bootstrap_ratio(kParts, other_seed)->low);
}

TEST(Bootstrap, OneCaptureHasNoInterval) {
  EXPECT_FALSE(bootstrap_ratio({}));
  EXPECT_FALSE(bootstrap_ratio({{1.0, 1.0}}));
  EXPECT_FALSE(bootstrap_ratio({{1.0, 1.0}, {0.0, 0.0}}));
}

// Of means of 30 normal numbers the percentile interval holds the true mean in 92.9 % of cases (2000 trials
// by numpy).
TEST(Bootstrap, HoldsTheTruthAsOftenAsItShould) {
  constexpr int trials = 1000;
  constexpr int parts = 30;
  Random random(11);
  BootstrapParams params;
  params.resamples = 400;
  int held = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<RatioPart> sample;
    for (int i = 0; i < parts; ++i) {
      const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
      sample.push_back({5.0 + radius * std::cos(2.0 * std::numbers::pi * random.uniform()), 1.0});
    }
    params.seed = static_cast<std::uint64_t>(trial);
    const auto interval = bootstrap_ratio(sample, params);
    if (interval->low <= 5.0 && interval->high >= 5.0) ++held;
  }
  const double share = static_cast<double>(held) / trials;
  EXPECT_NEAR(share, 0.929, 4.0 * std::sqrt(0.929 * 0.071 * (1.0 / trials + 1.0 / 2000.0)));
}

TEST(Bootstrap, ResamplesCapturesNotItems) {
  // Ten items, all of two captures: the ends are the means of the captures.
  std::vector<ItemSeries> items;
  for (int i = 0; i < 5; ++i) {
    items.push_back(series("a", 100.0, {measured(0, 101.0, 2.0)}));
    items.push_back(series("b", 100.0, {measured(1, 94.0, 2.0)}));
  }
  const auto mape = mape_interval(items);
  const auto bias = bias_interval(items);
  const auto coverage = coverage_interval(items);
  ASSERT_TRUE(mape && bias && coverage);
  EXPECT_NEAR(mape->low, 1.0, 1e-12);
  EXPECT_NEAR(mape->high, 6.0, 1e-12);
  EXPECT_NEAR(bias->low, -6.0, 1e-12);
  EXPECT_NEAR(bias->high, 1.0, 1e-12);
  EXPECT_NEAR(coverage->low, 0.0, 1e-12);
  EXPECT_NEAR(coverage->high, 100.0, 1e-12);
}

TEST(Bootstrap, HoldsTheFigureItself) {
  std::vector<ItemSeries> items;
  for (int i = 0; i < 12; ++i)
    items.push_back(series(std::to_string(i), 100.0, {measured(i, 98.0 + i), refused(i)}));
  const SetFigures figures = set_figures(items);
  const auto mape = mape_interval(items);
  const auto bias = bias_interval(items);
  ASSERT_TRUE(mape && bias);
  EXPECT_LT(mape->low, figures.mape);
  EXPECT_GT(mape->high, figures.mape);
  EXPECT_LT(bias->low, figures.bias);
  EXPECT_GT(bias->high, figures.bias);
  EXPECT_FALSE(coverage_interval(items));
}

}  // namespace
}  // namespace traygauge
