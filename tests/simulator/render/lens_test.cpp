// The lens against OpenCV's functions.
#include "simulator/render/lens.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/simulator/render/opencv_view_camera.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

ViewCamera camera_with(const std::array<double, 5>& distortion) {
  ViewCamera camera;
  camera.fx = 1210.0;
  camera.fy = 1195.0;
  camera.cx = 803.2;
  camera.cy = 588.7;
  camera.distortion = distortion;
  return camera;
}

std::vector<Eigen::Vector2d> pixels_of(const ViewCamera& camera) {
  std::vector<Eigen::Vector2d> pixels;
  for (int y = 0; y < camera.height; y += 109) {
    for (int x = 0; x < camera.width; x += 123) pixels.emplace_back(x, y);
  }
  pixels.emplace_back(camera.width - 1, camera.height - 1);
  return pixels;
}

// The largest difference to OpenCV both ways, in pixels.
double compare_with_opencv(const ViewCamera& camera) {
  const Lens lens(camera);
  double worst_px = 0.0;
  for (const Eigen::Vector2d& pixel : pixels_of(camera)) {
    const Eigen::Vector2d direction = lens.direction_of(pixel);
    std::vector<cv::Point2d> projected;
    cv::projectPoints(std::vector<cv::Point3d>{{3.0 * direction.x(), 3.0 * direction.y(), 3.0}}, cv::Vec3d(),
                      cv::Vec3d(), matrix_of(camera), coefficients_of(camera), projected);
    const Eigen::Vector2d expected(projected[0].x, projected[0].y);
    worst_px = std::max({worst_px, (expected - pixel).norm(), (lens.pixel_of(direction) - expected).norm()});

    std::vector<cv::Point2d> undistorted;
    cv::undistortPoints(std::vector<cv::Point2d>{{pixel.x(), pixel.y()}}, undistorted, matrix_of(camera),
                        coefficients_of(camera), cv::noArray(), cv::noArray(),
                        cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 500, 1e-14));
    const Eigen::Vector2d other(undistorted[0].x, undistorted[0].y);
    worst_px = std::max(worst_px, camera.fx * (other - direction).norm());
  }
  return worst_px;
}

TEST(Lens, AgreesWithOpenCvBothWays) {
  EXPECT_LT(compare_with_opencv(camera_with({})), 1e-9);
  EXPECT_LT(compare_with_opencv(camera_with({-0.12, 0.05, 0.001, -0.0005, 0.0})), 1e-6);
  EXPECT_LT(compare_with_opencv(camera_with({-0.28, 0.09, 0.002, -0.003, -0.01})), 1e-6) << "strong barrel";
  EXPECT_LT(compare_with_opencv(camera_with({0.30, 0.05, -0.004, 0.003, 0.02})), 1e-6) << "strong cushion";
}

TEST(Lens, AgreesWithOpenCvForAnyLens) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 30; ++i) {
    const ViewCamera camera = camera_with({0.12 * unit(random), 0.02 * unit(random), 0.003 * unit(random),
                                           0.003 * unit(random), 0.005 * unit(random)});
    EXPECT_LT(compare_with_opencv(camera), 1e-6) << "lens " << i;
  }
}

TEST(Lens, SlopeIsThatOfTheDirection) {
  const ViewCamera camera = camera_with({-0.28, 0.09, 0.002, -0.003, -0.01});
  const Lens lens(camera);
  constexpr double kStep_px = 0.01;
  for (const Eigen::Vector2d& pixel : pixels_of(camera)) {
    const Eigen::Matrix2d slope = lens.direction_by_pixel(lens.direction_of(pixel));
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = kStep_px * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d measured =
          (lens.direction_of(pixel + step) - lens.direction_of(pixel - step)) / (2.0 * kStep_px);
      EXPECT_LT((measured - slope.col(axis)).norm() * camera.fx, 1e-7);
    }
  }
}

// r (1 + k1 r²) turns back at r = 1 / √(-3 k1), where its image is 2/3 of that.
TEST(Lens, RefusesToFoldOverWithinThePicture) {
  ViewCamera camera = camera_with({});
  const double corner = std::hypot(803.2 / 1210.0, 611.3 / 1195.0);
  const double largest_k1 = 4.0 / (27.0 * corner * corner);
  camera.distortion[0] = -0.95 * largest_k1;
  EXPECT_NO_THROW(Lens{camera});
  camera.distortion[0] = -1.02 * largest_k1;
  EXPECT_THROW(Lens{camera}, std::invalid_argument);
}

TEST(Lens, RefusesCamerasThatMakeNoSense) {
  ViewCamera camera = camera_with({});
  camera.fx = 0.0;
  EXPECT_THROW(Lens{camera}, std::invalid_argument);
  camera = camera_with({});
  camera.height = 0;
  EXPECT_THROW(Lens{camera}, std::invalid_argument);
}

}  // namespace
}  // namespace traygauge
