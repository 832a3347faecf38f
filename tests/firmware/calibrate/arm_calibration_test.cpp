// The arm's axis from what its move did to the camera.
#include "firmware/calibrate/arm_calibration.hpp"

#include <gtest/gtest.h>

#include "tests/support/cameras.hpp"

namespace traygauge {
namespace {

using namespace test;

// The camera goes by `angle_deg` about an axis through `point`, in its own frame before the move.
Pose arm_move(double angle_deg, const Vec3& axis, const Vec3& point, double along_mm) {
  const Mat3 turn = rotation_about(axis.normalized() * angle_deg * std::numbers::pi / 180.0);
  return {turn, point - turn * point + along_mm * axis.normalized()};
}

TEST(ArmCalibration, AScrewIsTakenApart) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    const Vec3 axis = Vec3(normal(random), normal(random), normal(random)).normalized();
    const Vec3 point = 300.0 * Vec3(normal(random), normal(random), normal(random));
    const double angle_deg = 5.0 + 2.0 * i;
    const ScrewMotion motion = screw_of(arm_move(angle_deg, axis, point, 3.0));
    EXPECT_NEAR(motion.angle_deg, angle_deg, 1e-9);
    EXPECT_NEAR((motion.axis - axis).norm(), 0.0, 1e-9);
    EXPECT_NEAR(motion.along_axis_mm, 3.0, 1e-6);
    EXPECT_NEAR((motion.axis_point_mm - point).cross(axis).norm(), 0.0, 1e-6);
    EXPECT_NEAR(motion.axis_point_mm.dot(axis), 0.0, 1e-6);
  }
}

TEST(ArmCalibration, MeansOverTheMovesAndSaysHowTheyDiffer) {
  const Pose truth = arm_move(18.4, Vec3(1.0, 0.1, 0.0), Vec3(0.0, 20.0, 450.0), 0.0);
  std::vector<SeenMove> moves;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    moves.push_back({"", 18.0, perturbed(truth, 0.1, 1.0, seed)});
  ArmCalibration arm;
  ASSERT_TRUE(calibrate_arm(moves, {}, arm));
  EXPECT_NEAR(arm.motion.angle_deg, 18.4, 0.1);
  EXPECT_NEAR(arm.geometry.angle_deg(), arm.motion.angle_deg, 1e-9);
  EXPECT_EQ(arm.geometry.commanded_deg, 18.0);
  EXPECT_GT(arm.angle_spread_deg, 0.02);
  EXPECT_LT(arm.angle_spread_deg, 0.25);

  moves.push_back({"", 18.0, perturbed(truth, 0.6, 0.0, 9)});
  EXPECT_FALSE(calibrate_arm(moves, {}, arm));
  moves.back() = {"", 20.0, truth};
  EXPECT_FALSE(calibrate_arm(moves, {}, arm));
}

}  // namespace
}  // namespace traygauge
