// The picture of a measurement, read back by OpenCV.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "firmware/measure/drawing.hpp"
#include "tests/firmware/command_runner.hpp"
#include "tests/firmware/fake/fake_estimator.hpp"
#include "tests/firmware/fake/synthetic_scene.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

class PictureSheet : public testing::Test {
 protected:
  PictureSheet() : scene_(TemporaryCapture::kWidth, TemporaryCapture::kHeight) {
    fake_estimator() = {};
    fake_estimator().measurement = scene_.measurement();
    fake_estimator().pictures = scene_.pictures();
  }

  cv::Mat written() {
    const std::string file = files_.file("sheet.png").string();
    run({"measure", files_.folder().string(), "--picture", file});
    return cv::imread(file);
  }

  // Colours in one of the four panels (row by row).
  static double saturation(const cv::Mat& sheet, int panel) {
    const int width = sheet.cols / 2;
    const int height = sheet.rows / 2;
    cv::Mat hsv;
    cv::cvtColor(sheet(cv::Rect(panel % 2 * width, panel / 2 * height, width, height)), hsv,
                 cv::COLOR_BGR2HSV);
    return cv::mean(hsv)[1];
  }

  TemporaryCapture files_;
  SyntheticScene scene_;
};

TEST_F(PictureSheet, ShowsViewsDisparityAndHeights) {
  const cv::Mat sheet = written();
  ASSERT_EQ(sheet.size(), cv::Size(1608, 1310));
  for (int panel = 0; panel < 4; ++panel) EXPECT_GT(saturation(sheet, panel), 20.0) << panel;
}

TEST_F(PictureSheet, ShowsWhatWasReached) {
  Measurement& measurement = fake_estimator().measurement;
  measurement.status = StatusCode::rim_not_found;
  measurement.items = {};
  measurement.views.dish_bottom = Plane{};
  const cv::Mat half = written();
  EXPECT_GT(saturation(half, 2), 20.0);
  EXPECT_LT(saturation(half, 3), 60.0);
  measurement = {};
  fake_estimator().pictures = {};
  measurement.status = StatusCode::too_few_matches;
  const cv::Mat none = written();
  ASSERT_EQ(none.size(), half.size());
  EXPECT_LT(saturation(none, 2), saturation(half, 2));
}

TEST_F(PictureSheet, SurvivesMapsWithoutAKnownPixel) {
  std::vector<Disparity> unknown(64, kNoDisparity);
  std::vector<float> nowhere(64, std::numeric_limits<float>::quiet_NaN());
  fake_estimator().pictures.disparity = {unknown.data(), 8, 8};
  fake_estimator().pictures.depth_mm = {nowhere.data(), 8, 8};
  EXPECT_FALSE(written().empty());
}

TEST(ColourScale, EndsAreColouredAsTheirNumbers) {
  const cv::Mat values = (cv::Mat_<float>(1, 3) << 0.0F, 40.0F, std::numeric_limits<float>::quiet_NaN());
  const cv::Mat colours = colour_values(values, {0.0, 40.0, "mm"});
  const auto low = colours.at<cv::Vec3b>(0, 0);
  const auto high = colours.at<cv::Vec3b>(0, 1);
  const auto unknown = colours.at<cv::Vec3b>(0, 2);
  EXPECT_GT(low[0], low[2]);    // TURBO begins in blue
  EXPECT_GT(high[2], high[0]);  // and ends in red
  EXPECT_LT(std::abs(unknown[0] - unknown[2]), 16);
}

TEST(SpannedRange, LeavesOutliersAside) {
  cv::Mat values(1, 1000, CV_32F);
  for (int i = 0; i < 1000; ++i) values.at<float>(0, i) = static_cast<float>(i);
  values.at<float>(0, 3) = 1e9F;
  values.at<float>(0, 5) = std::numeric_limits<float>::quiet_NaN();
  double low = 0.0;
  double high = 0.0;
  ASSERT_TRUE(spanned_range(values, 0.01, low, high));
  EXPECT_NEAR(low, 11.0, 2.0);
  EXPECT_NEAR(high, 990.0, 2.0);
}

}  // namespace
}  // namespace traygauge
