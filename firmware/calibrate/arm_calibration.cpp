#include "firmware/calibrate/arm_calibration.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <numbers>

namespace traygauge {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

}  // namespace

// A point c of the axis moves along it only: c = R c + t − (a · t) a, solved for the c nearest to the origin.
ScrewMotion screw_of(const Pose& second_from_first) {
  const Eigen::AngleAxisd turn(second_from_first.rotation);
  ScrewMotion motion;
  motion.angle_deg = kDegrees * turn.angle();
  motion.axis = turn.axis();
  motion.along_axis_mm = motion.axis.dot(second_from_first.translation);
  const Vec3 across = second_from_first.translation - motion.along_axis_mm * motion.axis;
  // a aᵀ makes the singular I − R regular and keeps c off the axis's own direction.
  const Mat3 regular = Mat3::Identity() - second_from_first.rotation + motion.axis * motion.axis.transpose();
  motion.axis_point_mm = regular.inverse() * across;
  return motion;
}

bool calibrate_arm(const std::vector<SeenMove>& moves, const ArmCalibrationParams& params,
                   ArmCalibration& calibration) {
  calibration = {};
  Vec3 turn_rad = Vec3::Zero();
  Vec3 shift_mm = Vec3::Zero();
  double commanded_deg = 0.0;
  // Rotation vectors of moves that differ by tenths of a degree average like vectors.
  for (const SeenMove& move : moves) {
    const Eigen::AngleAxisd turn(move.second_from_first.rotation);
    turn_rad += turn.angle() * turn.axis() / static_cast<double>(moves.size());
    shift_mm += move.second_from_first.translation / static_cast<double>(moves.size());
    commanded_deg += move.commanded_deg / static_cast<double>(moves.size());
  }
  const Pose mean{rotation_about(turn_rad), shift_mm};
  double commanded_spread_deg = 0.0;
  for (const SeenMove& move : moves) {
    commanded_spread_deg = std::max(commanded_spread_deg, std::abs(move.commanded_deg - commanded_deg));
    calibration.angle_spread_deg =
        std::max(calibration.angle_spread_deg,
                 rotation_angle_deg(mean.rotation.transpose() * move.second_from_first.rotation));
    calibration.shift_spread_mm =
        std::max(calibration.shift_spread_mm, (move.second_from_first.translation - mean.translation).norm());
  }
  calibration.motion = screw_of(mean);
  calibration.geometry.commanded_deg = commanded_deg;
  for (int i = 0; i < 3; ++i) {
    calibration.geometry.turn_deg[static_cast<std::size_t>(i)] = kDegrees * turn_rad[i];
    calibration.geometry.shift_mm[static_cast<std::size_t>(i)] = shift_mm[i];
  }
  return commanded_spread_deg <= params.max_commanded_spread_deg &&
         calibration.angle_spread_deg <= params.max_angle_spread_deg &&
         calibration.shift_spread_mm <= params.max_shift_spread_mm;
}

}  // namespace traygauge
