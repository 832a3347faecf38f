// What tracks say about cameras and table: against OpenCV's epipolar lines and projections, and derivatives
// against differences.
#include "core/adjustment/track_residuals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>
#include <vector>

#include "tests/support/cameras.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kTrackFocalPx = 1400.0;

TableCameras random_cameras(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double azimuth = 6.28 * unit(random);
  return {test::camera_above(0.1 + 0.4 * unit(random), azimuth, 420.0 + 150.0 * unit(random)),
          test::camera_above(0.3 + 0.3 * unit(random), azimuth + 0.6 + unit(random),
                             420.0 + 150.0 * unit(random))};
}

Vec3 random_point(std::mt19937& random, double height_mm) {
  std::uniform_real_distribution<double> place(-150.0, 150.0);
  return {place(random), place(random), height_mm};
}

PointTrack track_of(const TableCameras& cameras, const Vec3& point) {
  PointTrack track;
  track.first = (cameras[0] * point).hnormalized();
  track.second = (cameras[1] * point).hnormalized();
  return track;
}

cv::Matx33d matrix_of(const Mat3& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

// The fundamental matrix from both projections, by the epipole and OpenCV's own lines.
TEST(TrackResiduals, OffLineIsTheDistanceFromOpenCvsEpipolarLine) {
  std::mt19937 random(test::random_seed());
  std::normal_distribution<double> off(0.0, 4.0 / kTrackFocalPx);
  for (int round = 0; round < 50; ++round) {
    const TableCameras cameras = random_cameras(random);
    PointTrack track = track_of(cameras, random_point(random, 20.0));
    const TrackResiduals residuals(cameras, kTrackFocalPx);
    double residual_px = 0.0;
    ASSERT_TRUE(residuals.off_line(track, residual_px));
    EXPECT_NEAR(residual_px, 0.0, 1e-8);
    track.second += Vec2(off(random), off(random));
    const Pose motion = second_from_first(cameras);
    const Vec3& t = motion.translation;
    const cv::Matx33d essential =
        cv::Matx33d(0.0, -t.z(), t.y(), t.z(), 0.0, -t.x(), -t.y(), t.x(), 0.0) * matrix_of(motion.rotation);
    std::vector<cv::Vec3d> lines;
    cv::computeCorrespondEpilines(std::vector<cv::Point2d>{{track.first.x(), track.first.y()}}, 1, essential,
                                  lines);
    const double distance = lines[0][0] * track.second.x() + lines[0][1] * track.second.y() + lines[0][2];
    ASSERT_TRUE(residuals.off_line(track, residual_px));
    EXPECT_NEAR(std::abs(residual_px), kTrackFocalPx * std::abs(distance), 1e-6);
    Eigen::Matrix<double, 6, 1> by_pair;
    double same_px = 0.0;
    ASSERT_TRUE(residuals.off_line(track, same_px, by_pair));
    EXPECT_NEAR(same_px, residual_px, 1e-9);
    // The pair's motion is stepped by stepping the second camera behind it.
    for (int i = 0; i < 6; ++i) {
      const double size = i < 3 ? 1e-6 : 1e-4;
      const auto at = [&](double step) {
        const Pose stepped = moved(motion, step * Eigen::Matrix<double, 6, 1>::Unit(i));
        double there_px = 0.0;
        EXPECT_TRUE(
            TrackResiduals({cameras[0], stepped * cameras[0]}, kTrackFocalPx).off_line(track, there_px));
        return there_px;
      };
      EXPECT_NEAR(by_pair[i], (at(size) - at(-size)) / (2.0 * size), 1e-4 * (1.0 + by_pair.norm())) << i;
    }
  }
}

TEST(TrackResiduals, AlongLineIsHowFarATablePointMoved) {
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 50; ++round) {
    const TableCameras cameras = random_cameras(random);
    const TrackResiduals residuals(cameras, kTrackFocalPx);
    const Vec3 point = random_point(random, 0.0);
    PointTrack track = track_of(cameras, point);
    double residual_px = 0.0;
    ASSERT_TRUE(residuals.along_line(track, residual_px));
    EXPECT_NEAR(residual_px, 0.0, 1e-8);
    // What stands 1 mm over the table on the same line of sight, by OpenCV's projection.
    const Vec3 eye = camera_centre_mm(cameras[0]);
    const Vec3 raised = point + (eye - point) / eye.z();
    const Pose& second = cameras[1];
    cv::Vec3d turn;
    cv::Rodrigues(matrix_of(second.rotation), turn);
    std::vector<cv::Point2d> seen;
    cv::projectPoints(std::vector<cv::Point3d>{{raised.x(), raised.y(), raised.z()}}, turn,
                      cv::Vec3d(second.translation.x(), second.translation.y(), second.translation.z()),
                      cv::Matx33d::eye(), {}, seen);
    const Vec2 before = track.second;
    track.second = Vec2(seen[0].x, seen[0].y);
    PairVector by_pair;
    double by_height_px = 0.0;
    ASSERT_TRUE(residuals.along_line(track, residual_px, by_pair, by_height_px));
    EXPECT_NEAR(std::abs(residual_px), kTrackFocalPx * (track.second - before).norm(), 1e-6);
    EXPECT_NEAR(std::abs(by_height_px), std::abs(residual_px), 0.02 * std::abs(residual_px));
    double same_px = 0.0;
    ASSERT_TRUE(residuals.along_line(track, same_px));
    EXPECT_NEAR(same_px, residual_px, 1e-9);
  }
}

// Through the chain to steps of both cameras, at tracks on their lines, where nothing is left out.
TEST(TrackResiduals, ChainToBothCamerasIsWhatDifferencesSay) {
  std::mt19937 random(test::random_seed());
  for (int round = 0; round < 50; ++round) {
    const TableCameras cameras = random_cameras(random);
    const TrackResiduals residuals(cameras, kTrackFocalPx);
    const PointTrack track = track_of(cameras, random_point(random, 0.5));
    double residual_px = 0.0;
    double by_height_px = 0.0;
    PairVector by_pair;
    Eigen::Matrix<double, 6, 1> line_by_pair;
    ASSERT_TRUE(residuals.along_line(track, residual_px, by_pair, by_height_px));
    const PairByCameras chain = residuals.by_cameras();
    const Eigen::Matrix<double, 1, kCameraParameters> along = by_pair.transpose() * chain;
    ASSERT_TRUE(residuals.off_line(track, residual_px, line_by_pair));
    const Eigen::Matrix<double, 1, kCameraParameters> off = line_by_pair.transpose() * chain.topRows<6>();
    for (int i = 0; i < kCameraParameters; ++i) {
      const double size = i % 6 < 3 ? 1e-6 : 1e-4;
      const auto at = [&](double step) {
        TableCameras stepped = cameras;
        Pose& camera = stepped[i < 6 ? 0 : 1];
        camera = moved(camera, step * Eigen::Matrix<double, 6, 1>::Unit(i % 6));
        const TrackResiduals there(stepped, kTrackFocalPx);
        Vec2 both;
        EXPECT_TRUE(there.off_line(track, both.x()));
        EXPECT_TRUE(there.along_line(track, both.y()));
        return both;
      };
      const Vec2 slope = (at(size) - at(-size)) / (2.0 * size);
      EXPECT_NEAR(off[i], slope.x(), 1e-4 * (1.0 + off.norm())) << i;
      EXPECT_NEAR(along[i], slope.y(), 1e-4 * (1.0 + along.norm())) << i;
    }
  }
}

TEST(TrackResiduals, SayNothingOnAnEpipoleOrAboveTheHorizon) {
  std::mt19937 random(3);
  const TableCameras cameras = random_cameras(random);
  const TrackResiduals residuals(cameras, kTrackFocalPx);
  PointTrack track = track_of(cameras, camera_centre_mm(cameras[1]));
  double residual_px = 0.0;
  // The other camera's own place: its ray in the first view, whatever the second says.
  track.second = Vec2::Zero();
  const Vec3 epipole = cameras[0] * camera_centre_mm(cameras[1]);
  ASSERT_GT(std::abs(epipole.z()), 1.0);
  EXPECT_FALSE(residuals.off_line(track, residual_px));
  EXPECT_FALSE(residuals.along_line(track, residual_px));
  // A line of sight that goes up.
  const Vec3 up = cameras[0].rotation * Vec3(0.0, 0.0, 1.0);
  const Vec3 level = cameras[0].rotation * Vec3(1.0, 0.0, 0.1);
  const Vec3 sight = level.z() > 0.0 ? level : Vec3(level - 2.0 * level.dot(up) * up);
  track.first = (sight.z() > 0.0 ? sight : Vec3(-level + 0.2 * up)).hnormalized();
  const Vec3 rising = cameras[0].rotation.transpose() * track.first.homogeneous();
  if (rising.z() > 0.0) {
    EXPECT_FALSE(residuals.along_line(track, residual_px));
  }
}

}  // namespace
}  // namespace traygauge
