#include "firmware/verify/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "firmware/evaluate/statistics.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

// Printed in every table of them.
TEST(Intervals, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(student_quantile(0.975, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_quantile(0.975, 5), 2.571, 5e-4);
  EXPECT_NEAR(student_quantile(0.95, 9), 1.833, 5e-4);
  EXPECT_NEAR(student_quantile(0.975, 120), 1.980, 5e-4);
  EXPECT_NEAR(student_quantile(0.025, 5), -2.571, 5e-4);
  EXPECT_NEAR(student_quantile(0.975, 1e6), 1.960, 5e-4);
  EXPECT_NEAR(chi_squared_quantile(0.025, 9), 2.700, 5e-4);
  EXPECT_NEAR(chi_squared_quantile(0.975, 9), 19.023, 5e-4);
  EXPECT_NEAR(chi_squared_quantile(0.95, 1), 3.841, 5e-4);
  EXPECT_NEAR(chi_squared_quantile(0.5, 100), 99.334, 5e-4);
}

TEST(Intervals, SharesAreClopperAndPearsons) {
  // None of n: 1 - (0.025)^(1/n).
  const auto none = share_interval(0, 40);
  EXPECT_EQ(none->low, 0.0);
  EXPECT_NEAR(none->high, 1.0 - std::pow(0.025, 1.0 / 40.0), 1e-9);
  const auto all = share_interval(30, 30);
  EXPECT_NEAR(all->low, std::pow(0.025, 1.0 / 30.0), 1e-9);
  EXPECT_EQ(all->high, 1.0);
  const auto most = share_interval(28, 30);
  EXPECT_NEAR(most->low, 0.7793, 5e-5);
  EXPECT_NEAR(most->high, 0.9918, 5e-5);
  EXPECT_FALSE(share_interval(0, 0));
}

// 1, 2, 3, 4: mean 2.5, deviation 1.291, t(3) = 3.182; half of 3.182 * 1.291 / 2.
TEST(Intervals, AMeanIsStudents) {
  const auto one = mean_interval({{1.0, 2.0, 3.0, 4.0}});
  EXPECT_NEAR(one->low, 2.5 - 2.0543, 5e-4);
  EXPECT_NEAR(one->high, 2.5 + 2.0543, 5e-4);
  EXPECT_FALSE(mean_interval({}));
  EXPECT_FALSE(mean_interval({{1.0, 2.0}, {1.0}}));
  const auto same = mean_interval({{2.0, 2.0}, {4.0, 4.0}});
  EXPECT_EQ(same->low, 3.0);
  EXPECT_EQ(same->high, 3.0);
}

// What differs between groups is no chance: it widens nothing. Two groups of equal spread and size have
// 2 (n - 1) degrees of freedom: t(6) = 2.447.
TEST(Intervals, GroupsAreStrata) {
  const auto two = mean_interval({{1.0, 2.0, 3.0, 4.0}, {101.0, 102.0, 103.0, 104.0}});
  const double half = 2.4469 * std::sqrt(2.0 * 1.6667 / 4.0) / 2.0;
  EXPECT_NEAR(two->low, 52.5 - half, 5e-4);
  EXPECT_NEAR(two->high, 52.5 + half, 5e-4);
}

TEST(Intervals, ADeviationsFactorsAreChiSquareds) {
  const auto ten = deviation_factors(10);
  EXPECT_NEAR(ten->low, std::sqrt(9.0 / 19.0228), 1e-5);
  EXPECT_NEAR(ten->high, std::sqrt(9.0 / 2.70039), 1e-5);
  EXPECT_FALSE(deviation_factors(1));
}

// Of 2,000 intervals about a known truth 95 % hold it; four standard deviations of that count are 2 %.
TEST(Intervals, HoldTheTruthAsOftenAsTheySay) {
  Random random(test::random_seed());
  const auto normal = [&] {
    return std::sqrt(-2.0 * std::log(1.0 - random.uniform())) *
           std::cos(6.283185307179586 * random.uniform());
  };
  constexpr int kTrials = 2000;
  int mean_held = 0;
  int deviation_held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 6; ++i) values.push_back(3.0 + 2.0 * normal());
    const auto interval = mean_interval({values});
    if (interval->low <= 3.0 && interval->high >= 3.0) ++mean_held;
    const double deviation = sample_deviation(values);
    const auto factors = deviation_factors(6);
    if (deviation * factors->low <= 2.0 && deviation * factors->high >= 2.0) ++deviation_held;
  }
  EXPECT_NEAR(mean_held / static_cast<double>(kTrials), 0.95, 0.025);
  EXPECT_NEAR(deviation_held / static_cast<double>(kTrials), 0.95, 0.025);
}

}  // namespace
}  // namespace traygauge
