#include "core/image/specular_suppression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

namespace traygauge {
namespace {

cv::Mat diffuse_of(const FrameView& frame, double specular_fraction) {
  cv::Mat specular(frame.height, frame.width, CV_8U);
  suppress_specular(frame, {specular_fraction}, {specular.data, specular.cols, specular.rows});
  return specular;
}

FrameView frame_of(const cv::Mat& picture, PixelFormat format) {
  return {picture.data, picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step[0]), format};
}

// A stored value is the square root of its light.
std::uint8_t stored(double light) {
  return static_cast<std::uint8_t>(std::lround(std::sqrt(light)));
}

TEST(Matte, ReflectionsAreTakenAwayByTheirShare) {
  constexpr double kRed = 0.299;  // of grey, ITU-R BT.601
  constexpr double kGreen = 0.587;
  for (const double reflected : {0.0, 2'000.0, 15'000.0, 35'000.0}) {
    const double red = 20'000.0;
    const double green = 6'000.0;  // and no blue: what is there of it is reflected
    const cv::Mat picture(1, 1, CV_8UC3,
                          cv::Scalar(stored(red + reflected), stored(green + reflected), stored(reflected)));
    for (const double share : {0.0, 0.3, 1.0}) {
      const double expected = std::sqrt(kRed * red + kGreen * green + (1.0 - share) * reflected);
      EXPECT_NEAR(diffuse_of(frame_of(picture, PixelFormat::rgb8), share).at<std::uint8_t>(0), expected, 1.0)
          << reflected << ", " << share;
    }
  }
}

TEST(Matte, OrderOfColoursAndRowsOfAnyLength) {
  cv::RNG rng(8);
  cv::Mat wide(37, 60, CV_8UC3);
  rng.fill(wide, cv::RNG::UNIFORM, 0, 256);
  const cv::Mat rgb = wide.colRange(3, 48);
  cv::Mat bgr(rgb.size(), CV_8UC3);
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      const auto& pixel = rgb.at<cv::Vec3b>(y, x);
      bgr.at<cv::Vec3b>(y, x) = {pixel[2], pixel[1], pixel[0]};
    }
  }
  const cv::Mat first = diffuse_of(frame_of(rgb, PixelFormat::rgb8), 0.3);
  const cv::Mat second = diffuse_of(frame_of(bgr, PixelFormat::bgr8), 0.3);
  EXPECT_LE(cv::norm(first, second, cv::NORM_INF), 1.0);
  EXPECT_GT(cv::norm(first, diffuse_of(frame_of(rgb, PixelFormat::rgb8), 0.0), cv::NORM_INF), 10.0);
}

TEST(Matte, GreyFramesStayAsTheyAre) {
  cv::Mat picture(20, 30, CV_8U);
  cv::RNG(9).fill(picture, cv::RNG::UNIFORM, 0, 256);
  EXPECT_EQ(cv::norm(diffuse_of(frame_of(picture, PixelFormat::gray8), 0.3), picture, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace traygauge
