// What one view sees of the dish and the food: points of the table frame on a grid whose neighbours are
// neighbours in the view's picture.
#pragma once

#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

struct SurfacePoint {
  float x_mm = 0.0F;
  float y_mm = 0.0F;
  float z_mm = 0.0F;
};

enum class SurfaceEvidence : std::uint8_t {
  none,    // no point
  filled,  // from its neighbours
  single,  // matched, not confirmed from the other view
  both,    // matched the same way from either view
};

struct SurfaceGrid {
  ImageView<const SurfacePoint> points;
  ImageView<const SurfaceEvidence> evidence;
  ImageView<const std::uint8_t> labels;  // of the view, at each sample; 0 outside of the dish
  Vec3 camera_mm = Vec3::Zero();         // the view's centre
};

}  // namespace traygauge
