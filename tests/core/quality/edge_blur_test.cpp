#include "core/quality/edge_blur.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::view_of;

constexpr int kSide = 240;
constexpr std::uint8_t kCard = 255;

// Dark blots on white, as sharp as pixels allow: drawn eight times as large and averaged.
cv::Mat draw_print(std::uint64_t seed, int dark, int bright) {
  constexpr int kScale = 8;
  cv::RNG rng(seed);
  cv::Mat large(kSide * kScale, kSide * kScale, CV_8U, cv::Scalar(bright));
  for (int i = 0; i < 60; ++i) {
    const cv::Point centre(rng.uniform(0, large.cols), rng.uniform(0, large.rows));
    const cv::Size axes(rng.uniform(50, 130), rng.uniform(50, 130));
    cv::ellipse(large, centre, axes, rng.uniform(0, 180), 0, 360, cv::Scalar(dark), cv::FILLED);
  }
  cv::Mat print;
  cv::resize(large, print, {kSide, kSide}, 0, 0, cv::INTER_AREA);
  return print;
}

cv::Mat labels_of_card() {
  cv::Mat labels = cv::Mat::zeros(kSide, kSide, CV_8U);
  labels(cv::Rect(12, 12, kSide - 24, kSide - 24)) = kCard;
  return labels;
}

EdgeBlur measure(const cv::Mat& picture) {
  static const cv::Mat labels = labels_of_card();
  return measure_edge_blur(view_of(picture), view_of(labels), kCard, {});
}

// The pixel itself is a box of variance 1/12.
TEST(EdgeBlur, IsThatOfTheGaussianThatBlurred) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const cv::Mat sharp = draw_print(seed, 30, 210);
    for (const double sigma_px : {0.7, 1.0, 1.5, 2.0, 3.0}) {
      cv::Mat blurred;
      cv::GaussianBlur(sharp, blurred, {0, 0}, sigma_px);
      const EdgeBlur blur = measure(blurred);
      ASSERT_TRUE(blur.is_measured) << "seed " << seed << " sigma " << sigma_px;
      const double expected_px = std::sqrt(sigma_px * sigma_px + 1.0 / 12.0);
      // Few edges run exactly across one of the four directions; the others look wider.
      EXPECT_GT(blur.sigma_px, 0.92 * expected_px) << "seed " << seed;
      EXPECT_LT(blur.sigma_px, 1.05 * expected_px + 0.25) << "seed " << seed;
    }
  }
}

TEST(EdgeBlur, FindsTheDirectionOfAShake) {
  const cv::Mat sharp = draw_print(3, 30, 210);
  constexpr int kLength_px = 9;
  for (const bool is_upright : {false, true}) {
    const cv::Mat kernel(is_upright ? kLength_px : 1, is_upright ? 1 : kLength_px, CV_32F,
                         cv::Scalar(1.0 / kLength_px));
    cv::Mat shaken;
    cv::filter2D(sharp, shaken, -1, kernel);
    // A box of 9 px: its edges rise evenly, as the steepest slope sees them 9 / √2π px wide.
    EXPECT_NEAR(measure(shaken).sigma_px, kLength_px / std::sqrt(2.0 * CV_PI), 0.7);
  }
}

TEST(EdgeBlur, NoiseAndContrastHardlyMatter) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    cv::Mat picture = draw_print(seed, 30, 210);
    cv::GaussianBlur(picture, picture, {0, 0}, 1.5);
    const double expected_px = measure(picture).sigma_px;
    cv::Mat noisy;
    cv::Mat noise(picture.size(), CV_16S);
    cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, 8.0);
    cv::add(picture, noise, noisy, cv::noArray(), CV_8U);
    EXPECT_NEAR(measure(noisy).sigma_px, expected_px, 0.3) << "seed " << seed;
    cv::Mat dull;
    picture.convertTo(dull, CV_8U, 0.3, 40.0);
    EXPECT_NEAR(measure(dull).sigma_px, expected_px, 0.1) << "seed " << seed;
  }
}

TEST(EdgeBlur, NothingIsMeasuredWithoutEdges) {
  const cv::Mat plain(kSide, kSide, CV_8U, cv::Scalar(128));
  EXPECT_FALSE(measure(plain).is_measured);
  const cv::Mat print = draw_print(1, 30, 210);
  const cv::Mat no_card = cv::Mat::zeros(kSide, kSide, CV_8U);
  EXPECT_FALSE(measure_edge_blur(view_of(print), view_of(no_card), kCard, {}).is_measured);
  EXPECT_FALSE(measure_edge_blur({}, {}, kCard, {}).is_measured);
}

TEST(EdgeBlur, DarkAndBrightArePercentiles) {
  const EdgeBlur blur = measure(draw_print(2, 41, 187));
  EXPECT_EQ(blur.dark, 41);
  EXPECT_EQ(blur.bright, 187);
}

}  // namespace
}  // namespace traygauge
