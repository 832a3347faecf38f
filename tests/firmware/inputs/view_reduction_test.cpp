#include "firmware/measure/view_reduction.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/geometry/camera.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

TEST(ViewReduction, BeginsWhereTheStagesNoLongerFit) {
  EXPECT_EQ(reduction_of({1600, 1200}), 1);
  EXPECT_EQ(reduction_of({3264, 2448}), 1);
  EXPECT_EQ(reduction_of({4000, 3000}), 2);
  EXPECT_EQ(reduction_of({3000, 4000}), 2);
  EXPECT_EQ(reduction_of({8192, 6144}), 3);
}

TEST(ViewReduction, PixelsAreMeansOfBlocks) {
  cv::RNG random(test::random_seed());
  for (const int factor : {2, 3}) {
    for (const PixelFormat format : {PixelFormat::gray8, PixelFormat::rgb8}) {
      LoadedView view;
      view.picture = Picture({24 * factor + factor - 1, 17 * factor}, format);
      const int channels = bytes_per_pixel(format);
      cv::Mat stored(view.picture.size.height, view.picture.size.width, CV_8UC(channels),
                     view.picture.pixels.data());
      random.fill(stored, cv::RNG::UNIFORM, 0, 256);
      cv::Mat oracle;
      cv::resize(stored(cv::Rect(0, 0, 24 * factor, 17 * factor)), oracle, {24, 17}, 0, 0, cv::INTER_AREA);
      reduce_view(view, factor);
      ASSERT_EQ(view.picture.size, (PictureSize{24, 17}));
      const cv::Mat ours(17, 24, CV_8UC(channels), view.picture.pixels.data());
      EXPECT_LE(cv::norm(ours, oracle, cv::NORM_INF), 1.0);
    }
  }
}

// The border of two labels stays where it is on the average, and no third label appears.
TEST(ViewReduction, LabelsKeepTheirBorders) {
  LoadedView view;
  view.picture = Picture({400, 400}, PixelFormat::gray8);
  view.labels = view.picture;
  cv::Mat labels(400, 400, CV_8UC1, view.labels.pixels.data());
  labels.setTo(1);
  cv::circle(labels, {201, 197}, 150, 7, cv::FILLED);
  const double area = cv::countNonZero(labels == 7);
  reduce_view(view, 2);
  const cv::Mat reduced_labels(200, 200, CV_8UC1, view.labels.pixels.data());
  EXPECT_EQ(cv::countNonZero(reduced_labels == 1) + cv::countNonZero(reduced_labels == 7), 200 * 200);
  EXPECT_NEAR(4.0 * cv::countNonZero(reduced_labels == 7), area, 0.002 * area);
}

// A ray meets the same place of the scene before and after.
TEST(ViewReduction, TheCameraSeesTheSame) {
  CameraDescription camera;
  camera.size = {4001, 3000};
  camera.fx_px = 3400.0;
  camera.fy_px = 3390.0;
  camera.cx_px = 2010.0;
  camera.cy_px = 1480.0;
  camera.distortion = {-0.1, 0.02, 0.001, -0.001, 0.0};
  const LensModel before = lens_of(camera);
  const LensModel after = lens_of(reduced(camera, 2));
  EXPECT_EQ(after.width, 2000);
  EXPECT_EQ(after.height, 1500);
  for (const Vec2& ray : {Vec2(0.0, 0.0), Vec2(0.4, -0.3), Vec2(-0.5, 0.35)}) {
    const Vec2 pixel = before.pixel(ray);
    // Pixel centres: the block of pixels 2 i and 2 i + 1 has its middle at 2 i + 0.5.
    EXPECT_LT((2.0 * after.pixel(ray) + Vec2(0.5, 0.5) - pixel).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace traygauge
