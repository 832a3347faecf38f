#include "core/quality/view_input.hpp"

#include <cmath>

namespace traygauge {

Status check_sizes(const FrameView& frame, ImageView<const std::uint8_t> labels, const LensModel& lens,
                   const FrameLimits& limits) {
  if (frame.empty()) return StatusCode::frame_missing;
  if (frame.width != lens.width || frame.height != lens.height) return StatusCode::frame_size_mismatch;
  if (frame.width > limits.max_frame_width || frame.height > limits.max_frame_height) {
    return StatusCode::frame_size_mismatch;
  }
  return labels.width == frame.width && labels.height == frame.height ? StatusCode::ok
                                                                      : StatusCode::labels_size_mismatch;
}

Status check_labels(const LabelRegions& regions) {
  bool has_dish = false;
  bool has_food = false;
  for (std::size_t value = kDishLabel; value <= kLastFurtherDishLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    if (regions.pixels[value] == 0) continue;
    has_dish = has_dish || is_dish(label);
    has_food = has_food || is_item(label);
  }
  if (!has_food) return has_dish ? StatusCode::no_food_label : StatusCode::no_dish_label;
  return regions.touches_edge(regions.dish) ? StatusCode::dish_cut_off : StatusCode::ok;
}

Status check_angle(double relative_angle_deg, const ViewGeometryParams& params) {
  if (relative_angle_deg < params.min_angle_deg) return StatusCode::views_too_close;
  if (relative_angle_deg > params.max_angle_deg) return StatusCode::views_too_far_apart;
  return StatusCode::ok;
}

void warn_about_angles(const ViewAngles& angles, const ViewGeometryParams& params, WarningSet& warnings) {
  warnings.raise_if(angles.relative_deg < params.small_angle_deg, Warning::angle_small);
  warnings.raise_if(angles.relative_deg > params.large_angle_deg, Warning::angle_large);
  if (!angles.first_arm_deg || !angles.second_arm_deg) return;
  const double commanded_deg = std::abs(*angles.second_arm_deg - *angles.first_arm_deg);
  warnings.raise_if(std::abs(commanded_deg - angles.rotation_deg) > params.max_arm_deviation_deg,
                    Warning::arm_angle_disagrees);
}

}  // namespace traygauge
