// One picture to measure.
#pragma once

#include <cstdint>
#include <optional>

#include "core/geometry/camera.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Pixels and labels belong to the caller and stay valid until the measurement is done.
struct ViewInput {
  FrameView frame;
  ImageView<const std::uint8_t> labels;  // empty where nobody outlined the picture
  std::optional<LensModel> lens;         // a camera of its own; else the configuration's
  std::optional<double> arm_angle_deg;   // commanded, about the arm's axis
};

}  // namespace traygauge
