// Where a pixel of one view appears in the other: OpenCV projects points of the table into both.
#include "core/tracking/height_transfer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

#include "tests/support/cameras.hpp"
#include "tests/support/opencv_camera.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

Vec2 seen_by_opencv(const Pose& camera, const LensModel& lens, const Vec3& point) {
  const Mat3& r = camera.rotation;
  cv::Vec3d turn;
  cv::Rodrigues(cv::Matx33d(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
                turn);
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{{point.x(), point.y(), point.z()}}, turn,
                    cv::Vec3d(camera.translation.x(), camera.translation.y(), camera.translation.z()),
                    test::camera_matrix(lens.pinhole), test::distortion_of(lens), pixels);
  return {pixels[0].x, pixels[0].y};
}

struct TransferScene {
  LensModel lens = test::phone_lens();
  TableCameras cameras = {test::camera_above(0.2, 0.4, 480.0), test::camera_above(0.5, 1.0, 520.0)};
  HeightTransfer transfer{lens, lens, cameras};
};

TEST(HeightTransfer, LeadsToWhereOpenCvProjectsThePoint) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> place(-120.0, 120.0);
  std::uniform_real_distribution<double> height(-5.0, 80.0);
  const TransferScene scene;
  for (int i = 0; i < 300; ++i) {
    const Vec3 point(place(random), place(random), height(random));
    TableRay ray;
    ASSERT_TRUE(scene.transfer.cast_ray(seen_by_opencv(scene.cameras[0], scene.lens, point), ray));
    Vec3 found;
    ASSERT_TRUE(scene.transfer.point_at(ray, point.z(), found));
    EXPECT_LT((found - point).norm(), 1e-3);
    Vec2 pixel;
    ASSERT_TRUE(scene.transfer.transfer(ray, point.z(), pixel));
    EXPECT_LT((pixel - seen_by_opencv(scene.cameras[1], scene.lens, point)).norm(), 1e-2);
    TransferredPixel transferred;
    ASSERT_TRUE(scene.transfer.transfer(ray, point.z(), transferred));
    EXPECT_EQ(transferred.pixel, pixel);
    // The map takes neighbours on the level along.
    for (const Vec2& step : {Vec2(1.5, 0.0), Vec2(0.0, -1.5), Vec2(-1.0, 1.0)}) {
      const Vec3 beside = point + Vec3(step.x(), step.y(), 0.0);
      const Vec2 in_first = seen_by_opencv(scene.cameras[0], scene.lens, beside) -
                            seen_by_opencv(scene.cameras[0], scene.lens, point);
      const Vec2 in_second = seen_by_opencv(scene.cameras[1], scene.lens, beside) -
                             seen_by_opencv(scene.cameras[1], scene.lens, point);
      EXPECT_LT((transferred.second_from_first * in_first - in_second).norm(), 0.1);
    }
  }
}

TEST(HeightTransfer, FailsWhereNoPointCanBeSeen) {
  const TransferScene scene;
  TableRay ray;
  ASSERT_TRUE(scene.transfer.cast_ray(Vec2(800.0, 600.0), ray));
  Vec3 point;
  Vec2 pixel;
  EXPECT_FALSE(scene.transfer.point_at(ray, 600.0, point));  // above the camera
  EXPECT_FALSE(scene.transfer.transfer(ray, 600.0, pixel));
  ray.direction.z() = -ray.direction.z();  // up
  EXPECT_FALSE(scene.transfer.point_at(ray, 0.0, point));
  // A second camera that looks the other way.
  TableCameras apart = scene.cameras;
  apart[1] = Pose{Mat3(Vec3(1.0, -1.0, -1.0).asDiagonal()) * apart[1].rotation, -apart[1].translation};
  const HeightTransfer away(scene.lens, scene.lens, apart);
  ASSERT_TRUE(away.cast_ray(Vec2(800.0, 600.0), ray));
  TransferredPixel transferred;
  EXPECT_FALSE(away.transfer(ray, 0.0, pixel));
  EXPECT_FALSE(away.transfer(ray, 0.0, transferred));
}

}  // namespace
}  // namespace traygauge
