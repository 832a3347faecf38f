#include <gtest/gtest.h>

#include "tests/core/paper/reference_matcher.hpp"

namespace traygauge::paper {
namespace {

using test::match;
using test::match_by_definition;
using test::random_texture;
using test::TestPair;

StereoParams random_params(cv::RNG& rng) {
  StereoParams params;
  params.cost = static_cast<MatchingCost>(rng.uniform(0, 3));
  params.census_radius_px = rng.uniform(1, 5);
  params.sad_limit = rng.uniform(1, 256);
  params.zncc_weight = rng.uniform(1.0, 48.0);
  params.window_radius_px = rng.uniform(0, 5);
  params.levels = rng.uniform(1, 5);
  params.band_px = rng.uniform(0, 5);
  params.band_reach_px = rng.uniform(0, 3);
  params.smoothness = rng.uniform(0.0, 20.0);
  params.smoothness_deviation = rng.uniform(0.5, 20.0);
  params.variance_radius_px = rng.uniform(1, 9);
  params.median_radius_px = rng.uniform(0, 4);
  return params;
}

void cut_mask(cv::Mat_<std::uint8_t>& mask, cv::RNG& rng) {
  if (rng.uniform(0, 3) == 0) return;
  cv::RotatedRect dish(
      {rng.uniform(0.3F, 0.7F) * static_cast<float>(mask.cols), 0.5F * static_cast<float>(mask.rows)},
      {rng.uniform(0.3F, 1.2F) * static_cast<float>(mask.cols), 0.9F * static_cast<float>(mask.rows)},
      rng.uniform(-30.0F, 30.0F));
  mask = 0;
  cv::ellipse(mask, dish, 255, cv::FILLED);
  if (rng.uniform(0, 2) == 0) cv::circle(mask, {mask.cols / 2, mask.rows / 2}, mask.rows / 5, 0, cv::FILLED);
}

TestPair random_pair(cv::RNG& rng) {
  const int height = rng.uniform(5, 45);
  const auto wide = random_texture(80, height, rng.next());
  const cv::Rect first(rng.uniform(0, 20), 0, rng.uniform(20, 55), height);
  const cv::Rect second(rng.uniform(0, 20), 0, rng.uniform(20, 55), height);
  TestPair pair(wide(first).clone(), wide(second).clone());
  cv::Mat noise(pair.second.size(), CV_8U);
  rng.fill(noise, cv::RNG::UNIFORM, 0, 1 + rng.uniform(0, 30));
  pair.second += noise;
  // A uniform patch: variances of zero.
  pair.first(cv::Rect(2, 0, 12, height / 2)) = 77;
  pair.second(cv::Rect(4, 0, 10, height / 2)) = 77;
  cut_mask(pair.first_mask, rng);
  cut_mask(pair.second_mask, rng);
  return pair;
}

TEST(Reference, BlocksAndLanesEqualTheDefinitionBitForBit) {
  const std::uint64_t seed = 20260201;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  cv::RNG rng(seed);
  int matched = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const StereoParams params = random_params(rng);
    const TestPair pair = random_pair(rng);
    const int min_px = rng.uniform(-25, 10);
    const DisparityRange range{min_px, min_px + rng.uniform(0, 30)};
    const auto expected = match_by_definition(pair, range, params);
    const auto found = match(pair, range, params);
    for (int y = 0; y < expected.rows; ++y) {
      for (int x = 0; x < expected.cols; ++x) {
        ASSERT_EQ(found(y, x), expected(y, x))
            << "trial " << trial << " cost " << static_cast<int>(params.cost) << " levels " << params.levels
            << " at " << x << ", " << y << " of " << expected.cols << " x " << expected.rows;
        matched += expected(y, x) != kNoDisparity;
      }
    }
  }
  EXPECT_GT(matched, 50000);
}

}  // namespace
}  // namespace traygauge::paper
