// Whether a station's cameras see the card, and the arm's move as they saw it.
#pragma once

#include <optional>

#include "core/geometry/geometry.hpp"
#include "core/pipeline/configuration.hpp"
#include "firmware/check/device_check.hpp"
#include "firmware/config/station_file.hpp"

namespace traygauge {

// `camera_from_table` is set where the card is seen.
CheckResult check_card(const FrameView& picture, const LensModel& lens, const ReferenceCard& card,
                       std::optional<Pose>& camera_from_table);

struct MoveCheckParams {
  double max_angle_off_deg = 0.5;  // beyond, scans are refused
  // Of the camera's place after the move against the calibrated one, the card giving it to 1 or 2 mm.
  double max_shift_off_mm = 8.0;
};

// The card's places before and after the arm's move, against what was commanded and, where the arm was
// calibrated, the move that was seen then.
CheckResult check_move(const Pose& second_from_first, double commanded_deg,
                       const std::optional<ArmGeometry>& geometry, const MoveCheckParams& params = {});

}  // namespace traygauge
