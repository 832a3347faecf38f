// One of the two pictures, and what it shows where.
#pragma once

#include <cstdint>
#include <optional>

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

  // Where the stored picture shows a point of the table frame; false for what lies behind the camera.
  bool find_pixel(const Vec3& point_mm, Vec2& pixel) const {
    const Vec3 seen = camera_from_table * point_mm;
    if (!(seen.z() > 0.0)) return false;
    pixel = lens.pixel(seen.hnormalized());
    return true;
  }
  // Of the pixel around a place of the stored picture; nothing beside it.
  std::optional<std::uint8_t> label_at(const Vec2& pixel) const {
    const Vec2 corner = pixel + Vec2::Constant(0.5);
    if (!(corner.x() >= 0.0 && corner.y() >= 0.0 && corner.x() < labels.width && corner.y() < labels.height))
      return std::nullopt;
    return labels.at(static_cast<int>(corner.x()), static_cast<int>(corner.y()));
  }
};

// Pixels of the stored picture that a mm has at `place_mm`, in the table frame.
inline double px_per_mm(const SurfaceView& view, const Vec3& place_mm) {
  return view.lens.pinhole.mean_focal_px() / (view.camera_from_table * place_mm).norm();
}

}  // namespace traygauge
