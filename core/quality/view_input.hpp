// What every profile asks of a view before it looks at its pixels.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/status.hpp"
#include "core/geometry/camera.hpp"
#include "core/image_view/image_view.hpp"
#include "core/labels/label_regions.hpp"
#include "core/quality/warning.hpp"

namespace traygauge {

// The largest pictures that memory is taken for.
struct FrameLimits {
  int max_frame_width = 1600;
  int max_frame_height = 1200;
};

// How the views may lie to each other.
struct ViewGeometryParams {
  double min_angle_deg = 3.0;          // less: views_too_close; 1 px of disparity is then 9 mm of height
  double max_angle_deg = 60.0;         // more: views_too_far_apart
  double small_angle_deg = 10.0;       // warning (paper, Table V: errors rise below it)
  double large_angle_deg = 30.0;       // warning (paper, Table V: 30% error at 35 degrees)
  double max_arm_deviation_deg = 0.5;  // between commanded and measured angle: warning
};

// frame_missing; frame_size_mismatch with the lens or the memory; labels_size_mismatch with the frame.
Status check_sizes(const FrameView& frame, ImageView<const std::uint8_t> labels, const LensModel& lens,
                   const FrameLimits& limits);

// no_dish_label, no_food_label, or dish_cut_off when a dish touches the picture's edge.
Status check_labels(const LabelRegions& regions);

// views_too_close or views_too_far_apart.
Status check_angle(double relative_angle_deg, const ViewGeometryParams& params);

// Measured angles, and those that the arm was sent to where it has one.
struct ViewAngles {
  double relative_deg = 0.0;  // between the lines of sight, at the dish
  double rotation_deg = 0.0;  // of the camera
  std::optional<double> first_arm_deg;
  std::optional<double> second_arm_deg;
};

void warn_about_angles(const ViewAngles& angles, const ViewGeometryParams& params, WarningSet& warnings);

}  // namespace traygauge
