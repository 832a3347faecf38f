// The blurred prints against OpenCV's Gaussian blur in linear light.
#include "core/card/card_pattern.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/core/card/card_render.hpp"

namespace traygauge {
namespace {

constexpr double kMarginSigmas = 4.0;  // from the edge, which OpenCV repeats

TEST(CardPatternTest, LevelsAreTheGaussianBlurredPrint) {
  const CardModelSize size{85.60, 53.98, 0.8};
  const cv::Mat1b print = random_print(3);
  CardAligner aligner;
  ASSERT_TRUE(aligner.set_pattern(print, size).ok());
  cv::Mat1f light;
  cv::multiply(print, print, light, 1.0, CV_32F);
  for (const CardPatternLevel& level : aligner.pattern().levels) {
    const double sigma_x = level.blur_mm * print.cols / size.width_mm;
    const double sigma_y = level.blur_mm * print.rows / size.height_mm;
    cv::Mat1f blurred;
    cv::GaussianBlur(light, blurred, {}, sigma_x, sigma_y, cv::BORDER_REPLICATE);
    cv::sqrt(blurred, blurred);
    cv::Mat1f expected;
    const double scale_x = static_cast<double>(print.cols) / level.gray.width;
    const double scale_y = static_cast<double>(print.rows) / level.gray.height;
    const cv::Matx23d map(scale_x, 0.0, 0.5 * scale_x - 0.5, 0.0, scale_y, 0.5 * scale_y - 0.5);
    const cv::Size target(level.gray.width, level.gray.height);
    cv::warpAffine(blurred, expected, map, target, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    const int margin = static_cast<int>(kMarginSigmas * level.blur_mm * level.px_per_mm().x());
    double sum = 0.0;
    double signed_sum = 0.0;
    int count = 0;
    for (int y = margin; y < level.gray.height - margin; ++y) {
      for (int x = margin; x < level.gray.width - margin; ++x, ++count) {
        const double difference = level.gray.at(x, y) - static_cast<double>(expected(y, x));
        sum += difference * difference;
        signed_sum += difference;
      }
    }
    ASSERT_GT(count, 0);
    EXPECT_LT(std::sqrt(sum / count), 1.5) << level.blur_mm << " mm";
    EXPECT_LT(std::abs(signed_sum / count), 0.1) << level.blur_mm << " mm";
  }
}

TEST(CardPatternTest, LevelsFitTheirMemoryForAnyCard) {
  const cv::Mat1b print = random_print(3);
  CardAligner aligner;
  for (const CardModelSize& size : {CardModelSize{148.0, 105.0, 0.3}, CardModelSize{30.0, 20.0, 0.3}}) {
    ASSERT_TRUE(aligner.set_pattern(print, size).ok());
    double blur_mm = 0.0;
    for (const CardPatternLevel& level : aligner.pattern().levels) {
      EXPECT_GT(level.blur_mm, blur_mm);
      blur_mm = level.blur_mm;
      EXPECT_EQ(&aligner.pattern().nearest_level(1.1 * blur_mm), &level);
    }
  }
  for (const CardModelSize& size : {CardModelSize{0.0, 20.0, 0.3}, CardModelSize{85.6, 0.001, 0.3}})
    EXPECT_EQ(aligner.set_pattern(print, size).code(), StatusCode::invalid_configuration);
  EXPECT_EQ(aligner.set_pattern(cv::Mat1b(), {85.6, 54.0, 0.3}).code(), StatusCode::invalid_configuration);
}

TEST(CardPatternTest, MemoryForAnotherPatternIsAWrongCall) {
  const cv::Mat1b print = random_print(3);
  const CardAligner aligner;
  CardPattern pattern = aligner.pattern();
  pattern.storage.back() = pattern.storage.back().first(1);
  EXPECT_EQ(prepare_card_pattern(test::view_of(print), {85.6, 54.0, 0.3}, {}, pattern).code(),
            StatusCode::wrong_call);
}

}  // namespace
}  // namespace traygauge
