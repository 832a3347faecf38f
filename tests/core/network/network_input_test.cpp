// A frame made a network's picture, against OpenCV's reduction and by hand.
#include "core/network/network_input.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

FrameView frame_of(const cv::Mat& picture, PixelFormat format) {
  return {picture.data, picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step), format};
}

ImageView<std::uint8_t> view_of(cv::Mat3b& input) {
  return {input.data, 3 * input.cols, input.rows};
}

TEST(NetworkInput, IsOpenCvsReductionByArea) {
  cv::RNG random(test::random_seed());
  for (const cv::Size size : {cv::Size(160, 120), cv::Size(150, 110), cv::Size(77, 61), cv::Size(33, 25)}) {
    cv::Mat3b frame(size);
    random.fill(frame, cv::RNG::UNIFORM, 0, 256);
    cv::Mat3b input(24, 32);
    const InputPlacement place = fill_input(frame_of(frame, PixelFormat::rgb8), view_of(input));
    cv::Mat3b expected;
    cv::resize(frame, expected, {place.width, place.height}, 0, 0, cv::INTER_AREA);
    const cv::Mat3b placed = input(cv::Rect(place.left, place.top, place.width, place.height));
    EXPECT_LE(cv::norm(placed, expected, cv::NORM_INF), 1.0) << size;  // its sums are floats
  }
}

TEST(NetworkInput, LiesInTheMiddleOnGrey) {
  const cv::Mat3b frame(200, 100, cv::Vec3b(10, 20, 30));
  cv::Mat3b input(60, 80);
  const InputPlacement place = fill_input(frame_of(frame, PixelFormat::rgb8), view_of(input));
  EXPECT_EQ(place.width, 30);
  EXPECT_EQ(place.height, 60);
  EXPECT_EQ(place.left, 25);
  EXPECT_EQ(place.top, 0);
  EXPECT_EQ(input(30, 24), cv::Vec3b(kFillingGray, kFillingGray, kFillingGray));
  EXPECT_EQ(input(30, 25), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(input(59, 54), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(input(59, 55), cv::Vec3b(kFillingGray, kFillingGray, kFillingGray));
}

TEST(NetworkInput, PutsRedFirst) {
  cv::Mat3b input(16, 16);
  const cv::Mat3b bgr(32, 32, cv::Vec3b(1, 2, 3));
  fill_input(frame_of(bgr, PixelFormat::bgr8), view_of(input));
  EXPECT_EQ(input(5, 5), cv::Vec3b(3, 2, 1));
  const cv::Mat1b gray(32, 32, std::uint8_t{77});
  fill_input(frame_of(gray, PixelFormat::gray8), view_of(input));
  EXPECT_EQ(input(5, 5), cv::Vec3b(77, 77, 77));
}

// Means of 2 × 2 pixels whose sum leaves a half: rounded upward.
TEST(NetworkInput, RoundsHalvesUpward) {
  cv::Mat1b gray(32, 32, std::uint8_t{10});
  gray(0, 0) = 12;
  cv::Mat3b input(16, 16);
  fill_input(frame_of(gray, PixelFormat::gray8), view_of(input));
  EXPECT_EQ(input(0, 0)[0], 11);  // 10.5
  EXPECT_EQ(input(0, 1)[0], 10);
}

}  // namespace
}  // namespace traygauge
