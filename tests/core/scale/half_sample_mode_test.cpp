#include "core/scale/half_sample_mode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace traygauge {
namespace {

double mode(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return half_sample_mode(values);
}

TEST(HalfSampleMode, SmallSamplesByHand) {
  EXPECT_EQ(mode({}), 0.0);
  EXPECT_EQ(mode({7.0}), 7.0);
  EXPECT_EQ(mode({1.0, 3.0}), 2.0);
  EXPECT_EQ(mode({1.0, 2.0, 10.0}), 1.5);
  EXPECT_EQ(mode({1.0, 9.0, 10.0}), 9.5);
  EXPECT_EQ(mode({1.0, 2.0, 3.0}), 2.0);
  // Half of six is three: {4, 4.5, 4.6} is the narrowest, and its closer pair decides.
  EXPECT_DOUBLE_EQ(mode({1.0, 2.0, 4.0, 4.5, 4.6, 9.0}), 4.55);
}

TEST(HalfSampleMode, FollowsShiftAndScale) {
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> values(3 + random() % 200);
    for (double& value : values) value = gauss(random);
    std::vector<double> moved = values;
    for (double& value : moved) value = 4.0 * value + 16.0;
    EXPECT_NEAR(mode(moved), 4.0 * mode(values) + 16.0, 1e-9) << "trial " << trial;
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
}  // namespace traygauge
