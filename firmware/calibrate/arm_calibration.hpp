// What the arm's move does to the camera, from captures that show the card before and after it.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "firmware/config/station_file.hpp"

namespace traygauge {

// Of one capture: second_from_first by the card's places in both views.
struct SeenMove {
  std::string capture;
  double commanded_deg = 0.0;
  Pose second_from_first;
};

// The rotation that the move is, wherever its axis lies, and what is left of it along the axis.
struct ScrewMotion {
  double angle_deg = 0.0;
  Vec3 axis = Vec3::UnitX();          // unit, by the right hand; the first view's camera axes
  Vec3 axis_point_mm = Vec3::Zero();  // the axis's nearest point to the first view's centre
  double along_axis_mm = 0.0;         // 0 for an arm that only turns
};
ScrewMotion screw_of(const Pose& second_from_first);

struct ArmCalibrationParams {
  int min_captures = 3;
  // Between the moves: of an arm that repeats; the card gives an angle to about 0.1 degree, a place to 1 mm.
  double max_angle_spread_deg = 0.3;
  double max_shift_spread_mm = 4.0;
  double max_commanded_spread_deg = 0.05;  // captures of other moves do not belong together
};

struct ArmCalibration {
  ArmGeometry geometry;
  ScrewMotion motion;
  double angle_spread_deg = 0.0;  // largest difference from the mean rotation
  double shift_spread_mm = 0.0;   // ... from the mean shift
};

// Means over the moves, of which there is at least one. False when they differ by more than an arm that
// repeats may; `calibration` is filled in any case.
bool calibrate_arm(const std::vector<SeenMove>& moves, const ArmCalibrationParams& params,
                   ArmCalibration& calibration);

}  // namespace traygauge
