#include "core/geometry/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace traygauge {
namespace {

constexpr double kRayTolerance = 1e-11;      // of a ray's coordinates: below 1e-7 px at any focal length
constexpr double kSmallestRadialGain = 0.1;  // d(distorted)/d(ideal radius); a fold is near below it
constexpr int kRadiusSteps = 1024;           // of the monotony check, from the axis to kLargestRay
constexpr int kGridIntervals = 16;           // of the check over the picture's area; distortion is smooth

Mat3 matrix_of(const SensorTilt& tilt) {
  Mat3 matrix;
  matrix << tilt[0], tilt[1], tilt[2], tilt[3], tilt[4], tilt[5], tilt[6], tilt[7], tilt[8];
  return matrix;
}

struct DistortionTerms {
  double radial = 1.0;            // (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶)
  double radial_by_square = 0.0;  // its derivative by r²
};

DistortionTerms radial_terms(const LensModel& lens, double square) {
  const DistortionTerms above = {1.0 + square * (lens.k1 + square * (lens.k2 + square * lens.k3)),
                                 lens.k1 + square * (2.0 * lens.k2 + square * 3.0 * lens.k3)};
  if (!lens.further.is_used) return above;
  const FurtherDistortion& further = lens.further;
  const double below = 1.0 + square * (further.k4 + square * (further.k5 + square * further.k6));
  const double slope = further.k4 + square * (2.0 * further.k5 + square * 3.0 * further.k6);
  // Beyond a pole the lens would see the other side.
  if (!(below > 0.0)) return {0.0, 0.0};
  const double radial = above.radial / below;
  return {radial, (above.radial_by_square - radial * slope) / below};
}

// Where the lens moves an ideal ray before the sensor's tilt does.
Vec2 distort_upright(const LensModel& lens, const Vec2& ray) {
  const double x = ray.x();
  const double y = ray.y();
  const double square = ray.squaredNorm();
  const double radial = radial_terms(lens, square).radial;
  Vec2 distorted(x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (square + 2.0 * x * x),
                 y * radial + lens.p1 * (square + 2.0 * y * y) + 2.0 * lens.p2 * x * y);
  if (!lens.further.is_used) return distorted;
  const FurtherDistortion& further = lens.further;
  return distorted + square * Vec2(further.s1 + square * further.s2, further.s3 + square * further.s4);
}

// The distorted ray before the sensor's tilt; not finite where the tilted sensor does not see it.
Vec2 without_tilt(const LensModel& lens, const Vec2& distorted) {
  if (!lens.further.is_used) return distorted;
  return (matrix_of(lens.further.tilt).inverse() * distorted.homogeneous()).hnormalized();
}

Eigen::Matrix2d distortion_jacobian(const LensModel& lens, const Vec2& ray) {
  const double x = ray.x();
  const double y = ray.y();
  const auto [radial, slope] = radial_terms(lens, ray.squaredNorm());
  const double mixed = 2.0 * (x * y * slope + lens.p1 * x + lens.p2 * y);
  Eigen::Matrix2d jacobian;
  jacobian << radial + 2.0 * (x * x * slope + lens.p1 * y) + 6.0 * lens.p2 * x, mixed,  //
      mixed, radial + 2.0 * (y * y * slope + lens.p2 * x) + 6.0 * lens.p1 * y;
  if (!lens.further.is_used) return jacobian;
  const FurtherDistortion& further = lens.further;
  const double square = ray.squaredNorm();
  const Vec2 prism_by_square(further.s1 + 2.0 * square * further.s2, further.s3 + 2.0 * square * further.s4);
  return jacobian + prism_by_square * (2.0 * ray).transpose();
}

bool is_finite(const LensModel& lens) {
  const std::array<double, 9> values = {lens.pinhole.fx_px,
                                        lens.pinhole.fy_px,
                                        lens.pinhole.cx_px,
                                        lens.pinhole.cy_px,
                                        lens.k1,
                                        lens.k2,
                                        lens.p1,
                                        lens.p2,
                                        lens.k3};
  const FurtherDistortion& further = lens.further;
  const std::array<double, 7> more = {further.k4, further.k5, further.k6, further.s1,
                                      further.s2, further.s3, further.s4};
  const auto is_number = [](double value) { return std::isfinite(value); };
  return std::all_of(values.begin(), values.end(), is_number) &&
         (!further.is_used ||
          (std::all_of(more.begin(), more.end(), is_number) && matrix_of(further.tilt).allFinite()));
}

// Distance from the axis of the farthest corner (outer edge of the corner pixel), as a distorted ray.
double corner_radius(const LensModel& lens) {
  const Vec2 low = lens.pinhole.ray({-0.5, -0.5});
  const Vec2 high = lens.pinhole.ray({lens.width - 0.5, lens.height - 0.5});
  if (!lens.further.is_used) return low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm();
  double radius = 0.0;
  for (const double x : {low.x(), high.x()}) {
    for (const double y : {low.y(), high.y()}) radius = std::max(radius, without_tilt(lens, {x, y}).norm());
  }
  return radius;
}

// How far the terms that break the symmetry move a corner at most.
double off_axis_shift(const LensModel& lens, double corner) {
  const double square = corner * corner;
  const double tangential = 3.0 * (std::abs(lens.p1) + std::abs(lens.p2)) * corner * corner;
  if (!lens.further.is_used) return tangential;
  const FurtherDistortion& further = lens.further;
  return tangential + square * (std::abs(further.s1) + std::abs(further.s3) +
                                square * (std::abs(further.s2) + std::abs(further.s4)));
}

// Ideal radius at which the lens reaches `distorted`, climbing from the axis without a fold; negative if
// never.
double find_unfolded_radius(const LensModel& lens, double distorted) {
  for (int i = 0; i <= kRadiusSteps; ++i) {
    const double radius = kLargestRay * i / kRadiusSteps;
    const auto [radial, slope] = radial_terms(lens, radius * radius);
    if (!(radial + 2.0 * radius * radius * slope >= kSmallestRadialGain)) return -1.0;
    if (radius * radial >= distorted) return radius;
  }
  return -1.0;
}

// The tangential terms break the symmetry, so the whole picture is tried as well.
bool is_invertible_over_picture(const LensModel& lens, double largest_radius) {
  for (int j = 0; j <= kGridIntervals; ++j) {
    for (int i = 0; i <= kGridIntervals; ++i) {
      const Vec2 pixel(static_cast<double>(lens.width) * i / kGridIntervals - 0.5,
                       static_cast<double>(lens.height) * j / kGridIntervals - 0.5);
      Vec2 ray;
      if (!lens.undistort_pixel(pixel, ray) || ray.norm() > largest_radius) return false;
    }
  }
  return true;
}

}  // namespace

SensorTilt sensor_tilt(double tau_x_rad, double tau_y_rad) {
  const double cos_x = std::cos(tau_x_rad);
  const double sin_x = std::sin(tau_x_rad);
  const double cos_y = std::cos(tau_y_rad);
  const double sin_y = std::sin(tau_y_rad);
  Mat3 about_x;
  about_x << 1.0, 0.0, 0.0, 0.0, cos_x, sin_x, 0.0, -sin_x, cos_x;
  Mat3 about_y;
  about_y << cos_y, 0.0, -sin_y, 0.0, 1.0, 0.0, sin_y, 0.0, cos_y;
  const Mat3 turn = about_y * about_x;
  Mat3 projection;
  projection << turn(2, 2), 0.0, -turn(0, 2), 0.0, turn(2, 2), -turn(1, 2), 0.0, 0.0, 1.0;
  const Mat3 tilt = projection * turn;
  return {tilt(0, 0), tilt(0, 1), tilt(0, 2), tilt(1, 0), tilt(1, 1),
          tilt(1, 2), tilt(2, 0), tilt(2, 1), tilt(2, 2)};
}

Vec2 LensModel::distort(const Vec2& ray) const {
  Vec2 distorted = distort_upright(*this, ray);
  if (!further.is_used) return distorted;
  return (matrix_of(further.tilt) * distorted.homogeneous()).hnormalized();
}

bool LensModel::undistort_pixel(const Vec2& pixel, Vec2& ray) const {
  const Vec2 distorted = without_tilt(*this, pinhole.ray(pixel));
  Vec2 estimate = distorted;
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const Vec2 residual = distort_upright(*this, estimate) - distorted;
    const Eigen::Matrix2d jacobian = distortion_jacobian(*this, estimate);
    const double determinant = jacobian.determinant();
    if (!(determinant > 0.0)) return false;  // at or behind a fold, or not a number
    if (residual.norm() <= kRayTolerance) {
      ray = estimate;
      return true;
    }
    const Vec2 change(jacobian(1, 1) * residual.x() - jacobian(0, 1) * residual.y(),
                      jacobian(0, 0) * residual.y() - jacobian(1, 0) * residual.x());
    estimate -= change / determinant;
  }
  return false;
}

Status validate(const LensModel& lens) {
  const PinholeCamera& pinhole = lens.pinhole;
  if (lens.width < 2 || lens.height < 2 || !is_finite(lens)) return StatusCode::invalid_configuration;
  if (pinhole.fx_px <= 0.0 || pinhole.fy_px <= 0.0) return StatusCode::invalid_configuration;
  if (pinhole.cx_px < -0.5 || pinhole.cx_px > lens.width - 0.5 || pinhole.cy_px < -0.5 ||
      pinhole.cy_px > lens.height - 0.5) {
    return StatusCode::invalid_configuration;
  }
  // The tangential terms (at most 3 |p| r²) and the thin prism move a corner; the monotony must hold that
  // much further out.
  const double corner = corner_radius(lens);
  const double largest_radius = find_unfolded_radius(lens, corner + off_axis_shift(lens, corner));
  if (largest_radius < 0.0 || !is_invertible_over_picture(lens, largest_radius)) {
    return StatusCode::invalid_configuration;
  }
  return StatusCode::ok;
}

}  // namespace traygauge
