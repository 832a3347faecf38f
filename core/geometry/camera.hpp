// The camera: pinhole with OpenCV's lens distortion.
#pragma once

#include <array>

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
  bool operator==(const PinholeCamera&) const = default;
};

// Of a sensor that does not stand upright behind its lens: a homography of distorted rays, row by row.
using SensorTilt = std::array<double, 9>;

// The terms of OpenCV's model beyond its first five: few lenses need them, and they cost time.
struct FurtherDistortion {
  bool is_used = false;  // where not, nothing else here counts
  double k4 = 0.0;       // of the radial denominator
  double k5 = 0.0;
  double k6 = 0.0;
  double s1 = 0.0;  // thin prism: x moves by s1 r² + s2 r⁴, y by s3 r² + s4 r⁴
  double s2 = 0.0;
  double s3 = 0.0;
  double s4 = 0.0;
  SensorTilt tilt = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

  bool operator==(const FurtherDistortion&) const = default;
};

// OpenCV's homography of a sensor that is tilted about x, then y (τx and τy). Identity without a tilt.
SensorTilt sensor_tilt(double tau_x_rad, double tau_y_rad);

// The camera as calibrated: size, pinhole, and the coefficients of OpenCV's model.
struct LensModel {
  int width = 0;
  int height = 0;
  PinholeCamera pinhole;
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;
  FurtherDistortion further{};

  bool operator==(const LensModel&) const = default;

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
