#include "core/image/resample.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/random.hpp"
#include "tests/support/opencv_camera.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

using test::frame_of;
using test::random_picture;
using test::view_of;

TEST(ConvertToGray, EqualsOpenCvBitByBit) {
  cv::RNG rng(7);
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 5), cv::Size(257, 131), cv::Size(640, 480)}) {
    const cv::Mat picture = random_picture(size.width, size.height, CV_8UC3, rng);
    cv::Mat gray(size, CV_8U);
    cv::Mat expected;
    convert_to_gray(frame_of(picture), view_of(gray));
    cv::cvtColor(picture, expected, cv::COLOR_BGR2GRAY);
    EXPECT_EQ(cv::norm(gray, expected, cv::NORM_INF), 0.0);
    FrameView rgb = frame_of(picture);
    rgb.format = PixelFormat::rgb8;
    convert_to_gray(rgb, view_of(gray));
    cv::cvtColor(picture, expected, cv::COLOR_RGB2GRAY);
    EXPECT_EQ(cv::norm(gray, expected, cv::NORM_INF), 0.0);
  }
}

TEST(ConvertToGray, CopiesGrayAndHonoursStrides) {
  cv::RNG rng(8);
  const cv::Mat picture = random_picture(50, 40, CV_8U, rng);
  cv::Mat gray(60, 70, CV_8U, cv::Scalar(9));
  const cv::Mat part = picture(cv::Rect(5, 6, 31, 20));
  convert_to_gray(frame_of(part), view_of(gray).sub(3, 2, 31, 20));
  EXPECT_EQ(cv::norm(gray(cv::Rect(3, 2, 31, 20)), part, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::sum(gray)[0], cv::sum(part)[0] + 9.0 * (60 * 70 - 31 * 20));
}

class ReduceArea : public ::testing::TestWithParam<std::array<int, 4>> {};

// The definition: the mean over the covered area, in double precision.
double covered_mean(const cv::Mat& source, int x, int y, double fx, double fy) {
  double sum = 0.0;
  for (int j = 0; j < source.rows; ++j) {
    const double wy = std::min(j + 1.0, (y + 1) * fy) - std::max<double>(j, y * fy);
    if (wy <= 0.0) continue;
    for (int i = 0; i < source.cols; ++i) {
      const double wx = std::min(i + 1.0, (x + 1) * fx) - std::max<double>(i, x * fx);
      if (wx > 0.0) sum += wx * wy * source.at<std::uint8_t>(j, i);
    }
  }
  return sum / (fx * fy);
}

TEST_P(ReduceArea, IsWithinOneOfOpenCvAndHalfOfTheDefinition) {
  const auto [width, height, target_width, target_height] = GetParam();
  cv::RNG rng(static_cast<std::uint64_t>(width));
  const cv::Mat source = random_picture(width, height, CV_8U, rng);
  cv::Mat target(target_height, target_width, CV_8U);
  reduce_area(view_of(source), view_of(target));
  cv::Mat expected;
  cv::resize(source, expected, target.size(), 0, 0, cv::INTER_AREA);
  EXPECT_LE(cv::norm(target, expected, cv::NORM_INF), 1.0);
  const double fx = static_cast<double>(width) / target_width;
  const double fy = static_cast<double>(height) / target_height;
  for (int k = 0; k < 200; ++k) {
    const int x = rng.uniform(0, target_width);
    const int y = rng.uniform(0, target_height);
    ASSERT_NEAR(target.at<std::uint8_t>(y, x), covered_mean(source, x, y, fx, fy), 0.5 + 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, ReduceArea,
    ::testing::Values(std::array<int, 4>{160, 120, 160, 120}, std::array<int, 4>{160, 120, 80, 60},
                      std::array<int, 4>{160, 120, 126, 95}, std::array<int, 4>{333, 241, 100, 99},
                      std::array<int, 4>{2500, 40, 1975, 7},  // several blocks
                      std::array<int, 4>{2049, 31, 1025, 31}, std::array<int, 4>{17, 9, 1, 1},
                      std::array<int, 4>{1712, 50, 301, 9}));

TEST(ReduceArea, EnlargesByTheSameDefinition) {
  cv::RNG random(test::random_seed());
  const cv::Mat source = random_picture(37, 23, CV_8U, random);
  cv::Mat target(61, 80, CV_8U);
  reduce_area(view_of(source), view_of(target));
  for (int y = 0; y < target.rows; ++y) {
    for (int x = 0; x < target.cols; ++x)
      ASSERT_NEAR(target.at<std::uint8_t>(y, x), covered_mean(source, x, y, 37.0 / 80.0, 23.0 / 61.0),
                  0.5 + 1e-9);
  }
}

TEST(ReduceArea, SumsTheLargestPicturesWithoutOverflow) {
  const cv::Mat source(8192, 8192, CV_8U, cv::Scalar(255));
  cv::Mat target(1, 2, CV_8U);
  reduce_area(view_of(source), view_of(target));
  EXPECT_EQ(cv::norm(target, cv::Mat(1, 2, CV_8U, cv::Scalar(255)), cv::NORM_INF), 0.0);
}

TEST(ReduceColours, ReducesEachChannelByItself) {
  cv::RNG random(test::random_seed());
  const cv::Mat3b source = random_picture(600, 85, CV_8UC3, random);
  std::array<cv::Mat1b, 3> channels;
  cv::split(source, channels.data());
  cv::Mat3b reduced(31, 77);
  reduce_colours(frame_of(source), {reduced.data, 3 * reduced.cols, reduced.rows});
  for (int c = 0; c < 3; ++c) {
    cv::Mat1b expected(31, 77);
    cv::Mat1b own;
    reduce_area(view_of(channels[static_cast<std::size_t>(c)]), view_of(expected));
    cv::extractChannel(reduced, own, 2 - c);
    EXPECT_EQ(cv::norm(own, expected, cv::NORM_INF), 0.0) << c;
  }
}

TEST(ReduceArea, KeepsAUniformPicture) {
  for (int value = 0; value < 256; value += 5) {
    const cv::Mat source(97, 131, CV_8U, cv::Scalar(value));
    cv::Mat target(31, 64, CV_8U);
    reduce_area(view_of(source), view_of(target));
    EXPECT_EQ(cv::norm(target, cv::Mat(31, 64, CV_8U, cv::Scalar(value)), cv::NORM_INF), 0.0);
  }
}

class EnlargeLinear : public ::testing::TestWithParam<std::array<int, 4>> {};

TEST_P(EnlargeLinear, IsWithinOneOfOpenCv) {
  const auto [width, height, target_width, target_height] = GetParam();
  cv::RNG rng(static_cast<std::uint64_t>(width));
  const cv::Mat source = random_picture(width, height, CV_8U, rng);
  cv::Mat target(target_height, target_width, CV_8U);
  enlarge_linear(view_of(source), view_of(target));
  cv::Mat expected;
  cv::resize(source, expected, target.size(), 0, 0, cv::INTER_LINEAR);
  EXPECT_LE(cv::norm(target, expected, cv::NORM_INF), 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, EnlargeLinear,
    ::testing::Values(std::array<int, 4>{160, 120, 160, 120}, std::array<int, 4>{160, 120, 320, 240},
                      std::array<int, 4>{800, 600, 1095, 821}, std::array<int, 4>{333, 241, 401, 481},
                      std::array<int, 4>{1, 1, 7, 5}, std::array<int, 4>{2500, 17, 4096, 4096}));

LensModel lens_of(const cv::Mat& frame) {
  LensModel lens;
  lens.width = frame.cols;
  lens.height = frame.rows;
  lens.pinhole = {1.1 * frame.cols, 1.12 * frame.cols, 0.51 * frame.cols, 0.48 * frame.rows};
  lens.k1 = -0.12;
  lens.k2 = 0.05;
  lens.p1 = 0.001;
  lens.p2 = -0.0007;
  lens.k3 = 0.01;
  return lens;
}

// Smooth in every direction, so that interpolation of 1 / 32 px (OpenCV's) and of 1 / 256 px agree.
cv::Mat smooth_colours(int width, int height) {
  cv::RNG rng(3);
  cv::Mat picture = random_picture(width, height, CV_8UC3, rng);
  cv::GaussianBlur(picture, picture, cv::Size(), 4.0);
  cv::normalize(picture, picture, 0, 255, cv::NORM_MINMAX);
  return picture;
}

cv::Mat remap_through_lens(const cv::Mat& frame, const LensModel& lens, const Roi& cutout, int mode) {
  cv::Mat map_x, map_y, result;
  cv::initUndistortRectifyMap(test::camera_matrix(lens.pinhole), test::distortion_of(lens), cv::noArray(),
                              test::camera_matrix(cutout.camera), {cutout.width, cutout.height}, CV_32FC1,
                              map_x, map_y);
  cv::remap(frame, result, map_x, map_y, mode);
  return result;
}

// A cut-out that lies wholly inside the frame, `reduction` times smaller.
Roi inner_cutout(const LensModel& lens, double reduction) {
  Roi cutout;
  cutout.width = static_cast<int>(0.8 * lens.width / reduction);
  cutout.height = static_cast<int>(0.8 * lens.height / reduction);
  cutout.camera = {lens.pinhole.fx_px / reduction, lens.pinhole.fy_px / reduction, 0.5 * cutout.width,
                   0.5 * cutout.height};
  return cutout;
}

TEST(ResampleUndistorted, EqualsRemapWithoutReduction) {
  const cv::Mat frame = smooth_colours(640, 480);
  const LensModel lens = lens_of(frame);
  const Roi cutout = inner_cutout(lens, 1.0);
  cv::Mat gray(cutout.height, cutout.width, CV_8U);
  resample_undistorted(frame_of(frame), lens, cutout, view_of(gray));
  cv::Mat expected = remap_through_lens(frame, lens, cutout, cv::INTER_LINEAR);
  cv::cvtColor(expected, expected, cv::COLOR_BGR2GRAY);
  EXPECT_LE(cv::norm(gray, expected, cv::NORM_INF), 2.0);
  EXPECT_LE(cv::norm(gray, expected, cv::NORM_L1) / static_cast<double>(gray.total()), 0.3);
}

TEST(ResampleUndistorted, AveragesWhatATargetPixelCovers) {
  cv::RNG rng(5);
  const cv::Mat frame = random_picture(800, 600, CV_8UC3, rng);  // white noise: the worst case for aliasing
  const LensModel lens = lens_of(frame);
  for (const int reduction : {2, 3, 4}) {
    const Roi cutout = inner_cutout(lens, reduction);
    cv::Mat gray(cutout.height, cutout.width, CV_8U);
    resample_undistorted(frame_of(frame), lens, cutout, view_of(gray));
    // Reference: the same cut-out sampled 8 times finer, then averaged.
    Roi fine = cutout;
    constexpr int kFiner = 8;
    fine.width *= kFiner;
    fine.height *= kFiner;
    fine.camera = {cutout.camera.fx_px * kFiner, cutout.camera.fy_px * kFiner,
                   scale_coordinate(cutout.camera.cx_px, kFiner),
                   scale_coordinate(cutout.camera.cy_px, kFiner)};
    cv::Mat expected = remap_through_lens(frame, lens, fine, cv::INTER_LINEAR);
    cv::resize(expected, expected, gray.size(), 0, 0, cv::INTER_AREA);
    cv::cvtColor(expected, expected, cv::COLOR_BGR2GRAY);
    EXPECT_GT(cv::PSNR(gray, expected), 30.0) << "reduction " << reduction;
    cv::Mat single(gray.size(), CV_8U);
    resample_undistorted(frame_of(frame), lens, cutout, view_of(single), {.max_samples_per_axis = 1});
    EXPECT_LT(cv::PSNR(single, expected), cv::PSNR(gray, expected) - 3.0) << "reduction " << reduction;
  }
}

TEST(ResampleUndistorted, GrayFramesAndColourFramesAgree) {
  const cv::Mat frame = smooth_colours(320, 240);
  cv::Mat gray_frame;
  cv::cvtColor(frame, gray_frame, cv::COLOR_BGR2GRAY);
  const LensModel lens = lens_of(frame);
  const Roi cutout = inner_cutout(lens, 1.7);
  cv::Mat from_colour(cutout.height, cutout.width, CV_8U);
  cv::Mat from_gray(cutout.height, cutout.width, CV_8U);
  resample_undistorted(frame_of(frame), lens, cutout, view_of(from_colour));
  resample_undistorted(frame_of(gray_frame), lens, cutout, view_of(from_gray));
  EXPECT_LE(cv::norm(from_colour, from_gray, cv::NORM_INF), 1.0);
}

TEST(ResampleUndistorted, OutsideTheFrameIsBlackAndTheBorderIsNot) {
  const cv::Mat frame(60, 80, CV_8UC3, cv::Scalar(200, 200, 200));
  LensModel lens = lens_of(frame);
  lens.k1 = lens.k2 = lens.p1 = lens.p2 = lens.k3 = 0.0;
  Roi cutout{lens.pinhole, 100, 90};
  cutout.camera.cx_px += 10.0;  // the frame then fills columns 10 … 89 and rows 15 … 74
  cutout.camera.cy_px += 15.0;
  cv::Mat gray(cutout.height, cutout.width, CV_8U, cv::Scalar(77));
  resample_undistorted(frame_of(frame), lens, cutout, view_of(gray));
  cv::Mat expected = cv::Mat::zeros(cutout.height, cutout.width, CV_8U);
  expected(cv::Rect(10, 15, 80, 60)).setTo(200);
  EXPECT_EQ(cv::norm(gray, expected, cv::NORM_INF), 0.0);
}

TEST(ResampleLabels, TakesTheNearestLabelAndInventsNone) {
  cv::RNG rng(11);
  cv::Mat labels = cv::Mat::zeros(480, 640, CV_8U);
  for (int i = 0; i < 40; ++i) {
    const cv::Point centre(rng.uniform(0, 640), rng.uniform(0, 480));
    cv::circle(labels, centre, rng.uniform(5, 90), cv::Scalar(i % 2 == 0 ? 7 : 201), cv::FILLED);
  }
  const LensModel lens = lens_of(labels);
  Roi cutout = inner_cutout(lens, 0.8);  // reaches beyond the frame
  cv::Mat target(cutout.height, cutout.width, CV_8U, cv::Scalar(99));
  resample_labels_undistorted(view_of(labels), lens, cutout, view_of(target));
  const cv::Mat expected = remap_through_lens(labels, lens, cutout, cv::INTER_NEAREST);
  EXPECT_EQ(cv::countNonZero((target != 0) & (target != 7) & (target != 201)), 0);
  EXPECT_LE(cv::countNonZero(target != expected), static_cast<int>(target.total()) / 1000);
}

}  // namespace
}  // namespace traygauge
