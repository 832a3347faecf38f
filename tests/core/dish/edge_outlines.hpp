// Outlines of a dish's edge in closed form.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/dish/rim_residual.hpp"
#include "core/geometry/table_frame.hpp"
#include "tests/support/cameras.hpp"

namespace traygauge::test {

inline constexpr double kOutlineFocalPx = 1388.0;

// A camera so many degrees off the vertical, looking at the origin from 500 mm.
inline Pose camera_at(double tilt_deg, double azimuth_deg) {
  const double degree = std::numbers::pi / 180.0;
  return camera_above(tilt_deg * degree, azimuth_deg * degree, 500.0);
}

inline TableCameras two_cameras() {
  return {camera_at(8.0, 20.0), camera_at(24.0, 50.0)};
}

// The edge, `drop` lower where it is seen from outside.
inline std::vector<Vec2> outline_of(const DishPose& place, const Pose& camera, int points = 300) {
  std::vector<Vec2> rays;
  const Vec3 centre = camera_centre_mm(camera);
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / points;
    const Eigen::Rotation2Dd turn(place.azimuth_rad);
    const Vec2 flat = place.centre_mm + turn * Vec2(0.5 * place.size_mm[0] * std::cos(angle),
                                                    0.5 * place.size_mm[1] * std::sin(angle));
    const Vec2 outward = turn * Vec2(std::cos(angle) / place.size_mm[0], std::sin(angle) / place.size_mm[1]);
    const bool is_from_outside = outward.dot(centre.head<2>() - flat) > 0.0;
    const double height = place.edge_height_mm - (is_from_outside ? place.edge_drop_mm : 0.0);
    rays.emplace_back((camera * Vec3(flat.x(), flat.y(), height)).hnormalized());
  }
  return rays;
}

}  // namespace traygauge::test
