// One of the two pictures, and what it shows where.
#pragma once

#include <cstdint>

#include "core/geometry/camera.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/image/gray_pyramid.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

struct SurfaceView {
  const GrayPyramid& gray;
  const LensModel& lens;
  ImageView<const std::uint8_t> labels;
  Pose camera_from_table;
};

// Pixels of the stored picture that a mm has at `place_mm`, in the table frame.
inline double px_per_mm(const SurfaceView& view, const Vec3& place_mm) {
  return view.lens.pinhole.mean_focal_px() / (view.camera_from_table * place_mm).norm();
}

}  // namespace traygauge
