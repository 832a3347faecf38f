#include "core/paper/surface/depth_map.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/core/stereo/capture_scene.hpp"
#include "tests/core/stereo/synthetic_scene.hpp"

namespace traygauge::paper {
namespace {

TEST(DepthMap, ExactMatchesGiveTheExactDepthOfDishPixelsOnly) {
  const auto first = test::look_at_origin(480.0, 0.25, 0.4);
  const auto second = test::look_at_origin(520.0, 0.45, 1.1);
  const auto scene = test::render_height_field(
      first, 20.0, 50.0, [](double x, double y) { return 20.0 * (1.0 - (x * x + y * y) / 2500.0); });
  cv::Mat1b labels = scene.labels.clone();
  labels.rowRange(0, 40) = std::uint8_t{0};
  const CameraPair cameras{first.camera, second.camera, test::relative_pose(first, second)};
  cv::Mat1f depth(labels.size());
  const DepthMapReport report = fill_depth_map(
      test::view_of(labels), cameras,
      [&](const Vec2& pixel, Vec2& second_pixel) {
        if (pixel.y() < 50.0) return false;
        const double z = scene.depth_mm(static_cast<int>(pixel.y()), static_cast<int>(pixel.x()));
        const Vec3 point = cameras.second_from_first * (z * first.camera.ray(pixel).homogeneous());
        second_pixel = second.camera.pixel(point.head<2>() / point.z());
        return true;
      },
      test::view_of(depth));
  EXPECT_EQ(report.dish_pixels, 440U * 640U);
  EXPECT_EQ(report.known_pixels, 430U * 640U);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (y < 50) {
        EXPECT_TRUE(std::isnan(depth(y, x)));
      } else {
        EXPECT_NEAR(depth(y, x), scene.depth_mm(y, x), 1e-3F);
      }
    }
  }
}

TEST(DepthMap, AMatchBesideItsEpipolarLineMovesDepthInSecondOrderOnly) {
  const auto first = test::look_at_origin(500.0, 0.1, 0.0);
  const auto second = test::look_at_origin(500.0, 0.4, 0.0);
  const Pose pose = test::relative_pose(first, second);
  const Vec3 point(12.0, -30.0, 480.0);
  const Vec3 in_second = pose * point;
  const Vec3 off_line =
      pose.translation.cross(in_second).normalized() * (in_second.z() / 800.0);  // one pixel
  double depth = 0.0;
  ASSERT_TRUE(
      triangulate_depth(pose.rotation * (point / point.z()), in_second + off_line, pose.translation, depth));
  EXPECT_NEAR(depth, point.z(), 0.01);
}

TEST(DepthMap, RaysThatMeetBehindACameraOrNowhereGiveNoDepth) {
  const Pose pose{Mat3::Identity(), Vec3(-50.0, 0.0, 0.0)};
  double depth = 0.0;
  EXPECT_FALSE(triangulate_depth(Vec3(0, 0, 1), Vec3(0.1, 0, 1), pose.translation, depth));  // diverging
  EXPECT_FALSE(triangulate_depth(Vec3(0, 0, 1), Vec3(0, 0, 1), pose.translation, depth));    // parallel
  EXPECT_TRUE(triangulate_depth(Vec3(0, 0, 1), Vec3(-0.1, 0, 1), pose.translation, depth));
  EXPECT_DOUBLE_EQ(depth, 500.0);
}

TEST(DisparityLookup, InterpolatesOnOneSurfaceOnly) {
  cv::Mat_<Disparity> picture(2, 3);
  picture << 160, 168, 480, 164, 172, kNoDisparity;
  const auto view = test::view_of(picture);
  double disparity = 0.0;
  ASSERT_TRUE(lookup_disparity(view, 0.25, 0.5, disparity));
  EXPECT_NEAR(disparity, (0.75 * 162 + 0.25 * 170) / 16.0, 1e-12);
  ASSERT_TRUE(lookup_disparity(view, 1.4, 0.0, disparity));
  EXPECT_DOUBLE_EQ(disparity, 10.5);  // 30 px lie on another surface
  ASSERT_TRUE(lookup_disparity(view, 1.6, 0.0, disparity));
  EXPECT_DOUBLE_EQ(disparity, 30.0);
  ASSERT_TRUE(lookup_disparity(view, 1.9, 0.7, disparity));
  EXPECT_DOUBLE_EQ(disparity, 30.0);  // the nearest valid one
  EXPECT_FALSE(lookup_disparity(view, 3.0, 0.0, disparity));
  EXPECT_FALSE(lookup_disparity(view, std::nan(""), 0.0, disparity));
  picture.setTo(kNoDisparity);
  EXPECT_FALSE(lookup_disparity(view, 1.0, 0.5, disparity));
}

}  // namespace
}  // namespace traygauge::paper
