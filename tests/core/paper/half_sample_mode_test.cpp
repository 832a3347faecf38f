#include "core/paper/base/half_sample_mode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace traygauge::paper {
namespace {

constexpr ModeParams kSharpestPeak{.halvings = 32, .reach = 1.0};

double mode(std::vector<double> values, const ModeParams& params = kSharpestPeak) {
  std::sort(values.begin(), values.end());
  return half_sample_mode(values, params);
}

TEST(HalfSampleMode, SmallSamplesByHand) {
  for (const ModeParams& params : {ModeParams{}, kSharpestPeak, ModeParams{.halvings = 0, .reach = 1.0}}) {
    EXPECT_EQ(mode({}, params), 0.0);
    EXPECT_EQ(mode({7.0}, params), 7.0);
    EXPECT_EQ(mode({1.0, 3.0}, params), 2.0);
    EXPECT_DOUBLE_EQ(mode({1.0, 3.0, 5.0}, params), 3.0);
  }
  // Half of six is three: {4, 4.5, 4.6} is the narrowest.
  const std::vector<double> six{1.0, 2.0, 4.0, 4.5, 4.6, 9.0};
  EXPECT_DOUBLE_EQ(mode(six), 13.1 / 3.0);
  // Half of those again stops at three values; a wider reach takes in what lies within it: 2.5 to 6.1.
  EXPECT_DOUBLE_EQ(mode(six, {.halvings = 1, .reach = 6.0}), 13.1 / 3.0);
  EXPECT_DOUBLE_EQ(mode(six, {.halvings = 1, .reach = 8.0}), 15.1 / 4.0);
  EXPECT_DOUBLE_EQ(mode(six, {.halvings = 0, .reach = 1.0}), 25.1 / 6.0);
}

TEST(HalfSampleMode, KeepsThePrecisionOfTheMeanBesideOutliers) {
  constexpr int kTrials = 200;
  double square_trimmed = 0.0;
  double square_sharpest = 0.0;
  for (unsigned seed = 1; seed <= kTrials; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> peak(20.0, 0.5);
    std::uniform_real_distribution<double> wild(25.0, 80.0);
    std::vector<double> values;
    for (int i = 0; i < 120; ++i) values.push_back(peak(random));
    for (int i = 0; i < 80; ++i) values.push_back(wild(random));
    square_trimmed += std::pow(mode(values, {}) - 20.0, 2.0);
    square_sharpest += std::pow(mode(values) - 20.0, 2.0);
  }
  const double of_the_mean = 0.5 / std::sqrt(120.0);  // of the values about the peak, were they known
  EXPECT_LT(std::sqrt(square_trimmed / kTrials), 1.5 * of_the_mean);
  EXPECT_LT(std::sqrt(square_sharpest / kTrials), 0.5);
}

TEST(HalfSampleMode, FollowsShiftAndScale) {
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> values(3 + random() % 200);
    for (double& value : values) value = gauss(random);
    std::vector<double> moved = values;
    for (double& value : moved) value = 4.0 * value + 16.0;
    for (const ModeParams& params : {ModeParams{}, kSharpestPeak}) {
      EXPECT_NEAR(mode(moved, params), 4.0 * mode(values, params) + 16.0, 1e-9) << "trial " << trial;
    }
  }
}

TEST(HalfSampleMode, FindsThePeakOfKnownDistributions) {
  constexpr int kCount = 20000;
  double gamma_error = 0.0;
  double contaminated_error = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::gamma_distribution<double> gamma(3.0, 1.0);  // mode 2, mean 3, median 2.67
    std::normal_distribution<double> peak(10.0, 0.1);
    std::uniform_real_distribution<double> clutter(10.0, 40.0);
    std::vector<double> skewed(kCount);
    std::vector<double> contaminated(kCount);
    for (double& value : skewed) value = gamma(random);
    for (int i = 0; i < kCount; ++i) {
      contaminated[static_cast<std::size_t>(i)] = i % 3 == 0 ? peak(random) : clutter(random);
    }
    gamma_error += std::abs(mode(skewed) - 2.0) / 20.0;
    contaminated_error += std::abs(mode(contaminated) - 10.0) / 20.0;
  }
  EXPECT_LT(gamma_error, 0.3);          // it converges with the cube root only; the median is off by 0.67
  EXPECT_LT(contaminated_error, 0.05);  // two thirds of clutter, all on one side: the median is off by 7
}

}  // namespace
}  // namespace traygauge::paper
