// Against numpy 1.24 and scipy 1.10.
#include "firmware/evaluate/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace traygauge {
namespace {

const std::vector<double> kValues = {4.0, -1.0, 2.5, 8.0, 3.0};

TEST(Statistics, DeviationsAgreeWithNumpy) {
  EXPECT_DOUBLE_EQ(mean(kValues), 3.3);
  EXPECT_NEAR(population_deviation(kValues), 2.8913664589601926, 1e-14);
  EXPECT_NEAR(sample_deviation(kValues), 3.232645975048923, 1e-14);
}

TEST(Statistics, QuantilesAgreeWithNumpy) {
  EXPECT_NEAR(quantile(kValues, 0.025), -0.65, 1e-14);
  EXPECT_NEAR(quantile(kValues, 0.25), 2.5, 1e-14);
  EXPECT_NEAR(quantile(kValues, 0.9), 6.4, 1e-14);
  EXPECT_EQ(quantile(kValues, 0.0), -1.0);
  EXPECT_EQ(quantile(kValues, 1.0), 8.0);
  EXPECT_EQ(median(kValues), 3.0);
  EXPECT_EQ(median({1.0, 2.0, 10.0, 4.0}), 3.0);
}

TEST(Statistics, EqualValuesShareTheirRank) {
  const std::vector<double> values = {3.1, 0.5, 2.2, 2.2, 7.9, 1.0, 2.2, 5.5};
  EXPECT_EQ(ranks(values), (std::vector<double>{6.0, 1.0, 4.0, 4.0, 8.0, 2.0, 4.0, 7.0}));
}

TEST(Statistics, RankCorrelationAgreesWithScipy) {
  const std::vector<double> first = {3.1, 0.5, 2.2, 2.2, 7.9, 1.0, 2.2, 5.5};
  const std::vector<double> second = {1.0, 0.7, 3.3, 0.9, 2.8, 1.0, 0.1, 4.4};
  EXPECT_NEAR(rank_correlation(first, second), 0.5890568324085791, 1e-14);
  EXPECT_NEAR(rank_correlation({1.0, 2.0, 3.0}, {1.0, 8.0, 27.0}), 1.0, 1e-14);
  EXPECT_NEAR(rank_correlation({1.0, 2.0, 3.0}, {5.0, 4.0, -9.0}), -1.0, 1e-14);
}

TEST(Statistics, WhatIsNotDefinedIsNaN) {
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(population_deviation({})));
  EXPECT_TRUE(std::isnan(sample_deviation({1.0})));
  EXPECT_TRUE(std::isnan(rank_correlation({1.0}, {1.0})));
  EXPECT_TRUE(std::isnan(rank_correlation({1.0, 2.0}, {3.0, 3.0})));
}

}  // namespace
}  // namespace traygauge
