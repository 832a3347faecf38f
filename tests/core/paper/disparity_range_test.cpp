#include "core/paper/stereo/disparity_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace traygauge::paper {
namespace {

TEST(DisparityRange, KeepsTheCentralNinetyPercentAndEnlargesIt) {
  std::vector<double> disparities;
  for (int i = 0; i < 100; ++i) disparities.push_back(-20.5 + i);
  std::shuffle(disparities.begin(), disparities.end(), std::mt19937(1));
  const DisparityRangeParams params;
  DisparityRange range;
  ASSERT_TRUE(estimate_disparity_range(disparities, params, range).ok());
  EXPECT_EQ(range.min_px, -16 - params.enlargement_px);  // five are cut off: −15.5 is the lowest left
  EXPECT_EQ(range.max_px, 74 + params.enlargement_px);   // 73.5 the highest
}

TEST(DisparityRange, MismatchesInTheTailsDoNotWidenIt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> dish(-10.0, 30.0);
  std::vector<double> disparities;
  for (int i = 0; i < 200; ++i) disparities.push_back(dish(random));
  DisparityRange clean;
  auto copy = disparities;
  ASSERT_TRUE(estimate_disparity_range(copy, {}, clean).ok());
  for (int i = 0; i < 8; ++i) disparities.push_back(i % 2 == 0 ? -5000.0 : 5000.0);
  DisparityRange range;
  ASSERT_TRUE(estimate_disparity_range(disparities, {}, range).ok());
  EXPECT_NEAR(range.min_px, clean.min_px, 2);
  EXPECT_NEAR(range.max_px, clean.max_px, 2);
}

TEST(DisparityRange, RefusesTooFewMatchesAndTooWideRanges) {
  const DisparityRangeParams params;
  DisparityRange range;
  std::vector<double> few(static_cast<std::size_t>(params.min_matches - 1), 1.0);
  EXPECT_EQ(estimate_disparity_range(few, params, range).code(), StatusCode::too_few_matches);
  std::vector<double> wide;
  for (int i = 0; i < 100; ++i) wide.push_back(5.0 * i);
  EXPECT_EQ(estimate_disparity_range(wide, params, range).code(), StatusCode::disparity_range_too_large);
  wide.assign(20, 1e300);
  EXPECT_EQ(estimate_disparity_range(wide, params, range).code(), StatusCode::disparity_range_too_large);
}

// Also at the cap itself: max_count disparities pass, one more does not.
TEST(DisparityRange, TheCapIsACountOfDisparities) {
  DisparityRangeParams params;
  params.enlargement_px = 0;
  params.share = 1.0;
  params.min_matches = 2;
  params.max_count = 11;
  DisparityRange range;
  std::vector<double> fits{-3.0, 7.0};
  ASSERT_TRUE(estimate_disparity_range(fits, params, range).ok());
  EXPECT_EQ(range.count(), 11);
  std::vector<double> exceeds{-3.0, 7.5};
  EXPECT_EQ(estimate_disparity_range(exceeds, params, range).code(), StatusCode::disparity_range_too_large);
}

}  // namespace
}  // namespace traygauge::paper
