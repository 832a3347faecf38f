// A second camera that is not where it is said to be, and points that show where it is.
#include "core/tracking/pose_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/cameras.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kCorrectionFocalPx = 1400.0;

// Points of the table, and of food whose height is not known, as both cameras see them.
struct CorrectionScene {
  TableCameras truth = {test::camera_above(0.2, 0.4, 480.0), test::camera_above(0.45, 0.9, 520.0)};
  std::vector<SeenPoint> points;

  CorrectionScene(std::mt19937& random, double noise_px, double wrong_fraction) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> noise(0.0, noise_px / kCorrectionFocalPx);
    for (int i = 0; i < 60; ++i) {
      const bool is_table = i % 2 == 0;
      const Vec3 at(240.0 * unit(random) - 120.0, 200.0 * unit(random) - 100.0,
                    is_table ? 0.0 : 50.0 * unit(random));
      SeenPoint point;
      point.table_mm = at;
      point.first = (truth[0] * at).hnormalized();
      point.second = (truth[1] * at).hnormalized() + Vec2(noise(random), noise(random));
      point.height_known = is_table;
      if (!is_table) {  // taken for 20 mm high, whatever it is
        const Vec3 eye = camera_centre_mm(truth[0]);
        point.table_mm = eye + (eye.z() - 20.0) / (eye.z() - at.z()) * (at - eye);
      }
      if (unit(random) < wrong_fraction) point.second += 0.05 * Vec2(unit(random) - 0.5, unit(random) - 0.5);
      points.push_back(point);
    }
  }
  TableCameras corrected(std::uint64_t seed) const {
    TableCameras cameras = truth;
    cameras[1] = test::perturbed(cameras[1], 0.6, 3.0, seed);
    correct_second_pose(points, kCorrectionFocalPx, {}, cameras);
    return cameras;
  }
  // The farthest that the table's points lie from where they are seen.
  double off_px(const Pose& second) const {
    double most = 0.0;
    for (int x = -100; x <= 100; x += 50) {
      for (int y = -100; y <= 100; y += 50) {
        const Vec3 at(x, y, 0.0);
        most = std::max(
            most, kCorrectionFocalPx * ((second * at).hnormalized() - (truth[1] * at).hnormalized()).norm());
      }
    }
    return most;
  }
};

TEST(PoseCorrection, BringsTheCameraToWhereThePointsAreSeen) {
  const std::uint32_t seed = test::random_seed();
  std::mt19937 random(seed);
  for (std::uint32_t round = 0; round < 30; ++round) {
    const CorrectionScene exact(random, 0.0, 0.0);
    EXPECT_LT(exact.off_px(exact.corrected(seed + round)[1]), 0.5);
    const CorrectionScene noisy(random, 0.5, 0.0);
    EXPECT_LT(noisy.off_px(noisy.corrected(seed + round)[1]), 1.5);
  }
}

TEST(PoseCorrection, WrongPointsDoLittle) {
  const std::uint32_t seed = test::random_seed();
  std::mt19937 random(seed);
  int near = 0;
  for (std::uint32_t round = 0; round < 30; ++round) {
    const CorrectionScene scene(random, 0.3, 0.25);
    near += scene.off_px(scene.corrected(seed + round)[1]) < 2.0 ? 1 : 0;
  }
  EXPECT_GE(near, 27);
}

// Without points the camera stays where it was said to be; the first one stays in any case.
TEST(PoseCorrection, NothingSeenChangesNothing) {
  std::mt19937 random(5);
  CorrectionScene scene(random, 0.0, 0.0);
  TableCameras cameras = scene.truth;
  cameras[1] = test::perturbed(cameras[1], 0.5, 2.0, 9);
  const TableCameras before = cameras;
  correct_second_pose({}, kCorrectionFocalPx, {}, cameras);
  EXPECT_LT(test::rotation_error_deg(cameras[1], before[1]), 1e-6);
  EXPECT_LT((cameras[1].translation - before[1].translation).norm(), 1e-6);
  correct_second_pose(scene.points, kCorrectionFocalPx, {}, cameras);
  EXPECT_EQ(cameras[0].rotation, before[0].rotation);
  EXPECT_EQ(cameras[0].translation, before[0].translation);
}

}  // namespace
}  // namespace traygauge
