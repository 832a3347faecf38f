// The camera: pinhole with OpenCV's five-coefficient lens distortion.
#pragma once

#include "core/base/status.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

// tan 79°: no pinhole camera sees further out.
inline constexpr double kLargestRay = 5.0;
// Of a ray a unit of depth, towards the table: a flatter view, below 3 degrees, shows neither rim nor table.
inline constexpr double kMinDescent = 0.05;

// An undistorted picture's geometry. A ray is (X/Z, Y/Z): pixel = (fx * ray.x + cx, fy * ray.y + cy).
struct PinholeCamera {
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;

  Vec2 pixel(const Vec2& ray) const { return {fx_px * ray.x() + cx_px, fy_px * ray.y() + cy_px}; }
  Vec2 ray(const Vec2& pixel) const { return {(pixel.x() - cx_px) / fx_px, (pixel.y() - cy_px) / fy_px}; }
  double mean_focal_px() const { return 0.5 * (fx_px + fy_px); }
};

// The camera as calibrated: size, pinhole, and the radial and tangential coefficients of OpenCV's model.
struct LensModel {
  int width = 0;
  int height = 0;
  PinholeCamera pinhole;
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  // Where the lens moves an ideal ray.
  Vec2 distort(const Vec2& ray) const;
  // Where the stored picture shows an ideal ray.
  Vec2 pixel(const Vec2& ray) const { return pinhole.pixel(distort(ray)); }
  // The ideal ray behind a pixel of the stored picture; false where the model cannot be inverted there.
  bool undistort_pixel(const Vec2& pixel, Vec2& ray) const;
};

// invalid_configuration unless size and focal lengths are positive and finite, the principal point lies in
// the picture, and the distortion stays invertible up to the corners.
Status validate(const LensModel& lens);

}  // namespace traygauge
