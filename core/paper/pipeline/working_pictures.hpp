// What profile `paper` shows of a measurement beside its result.
#pragma once

#include <array>
#include <cstdint>

#include "core/geometry/camera.hpp"
#include "core/image_view/image_view.hpp"
#include "core/paper/surface/food_mesh.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge::paper {

// Valid until the next measurement.
struct WorkingPictures {
  std::array<PinholeCamera, 2> cameras;
  std::array<ImageView<const std::uint8_t>, 2> gray;  // undistorted, dish resized
  std::array<ImageView<const std::uint8_t>, 2> labels;
  std::array<ImageView<const std::uint8_t>, 2> rectified;
  ImageView<const Disparity> disparity;
  ImageView<const float> depth_mm;  // of the reference view, along its axis; NaN where unknown
  FoodMesh mesh;                    // in the reference camera, mm
};

}  // namespace traygauge::paper
