// How far each stage lies from the truth that a capture carries.
#pragma once

#include "core/geometry/geometry.hpp"
#include "core/pipeline/measurement.hpp"

namespace traygauge {

// What truth.json says about a pair: camera motion, and the dish in world coordinates (z up, table at 0).
struct PairTruth {
  Pose first_from_world;
  Pose second_from_world;
  double bottom_height_mm = 0.0;

  Pose second_from_first() const;
  double relative_angle_deg() const;  // between the lines of sight to the middle of the dish's bottom
};

struct StageErrors {
  double rotation_deg = 0.0;
  double direction_deg = 0.0;     // of the translation
  double scale_percent = 0.0;     // signed, of the baseline's length
  double bottom_tilt_deg = 0.0;   // of the dish bottom's plane
  double bottom_offset_mm = 0.0;  // signed, at the dish's centre; positive: too high, volumes too small
  double table_tilt_deg = 0.0;
  double table_offset_mm = 0.0;
};

// Needs a measurement that came as far as volumes.
StageErrors stage_errors(const Measurement& measurement, const PairTruth& truth);

}  // namespace traygauge
