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

struct DistortionTerms {
  double radial = 1.0;            // 1 + k1 r² + k2 r⁴ + k3 r⁶
  double radial_by_square = 0.0;  // its derivative by r²
};

DistortionTerms radial_terms(const LensModel& lens, double square) {
  return {1.0 + square * (lens.k1 + square * (lens.k2 + square * lens.k3)),
          lens.k1 + square * (2.0 * lens.k2 + square * 3.0 * lens.k3)};
}

Eigen::Matrix2d distortion_jacobian(const LensModel& lens, const Vec2& ray) {
  const double x = ray.x();
  const double y = ray.y();
  const auto [radial, slope] = radial_terms(lens, ray.squaredNorm());
  const double mixed = 2.0 * (x * y * slope + lens.p1 * x + lens.p2 * y);
  Eigen::Matrix2d jacobian;
  jacobian << radial + 2.0 * (x * x * slope + lens.p1 * y) + 6.0 * lens.p2 * x, mixed,  //
      mixed, radial + 2.0 * (y * y * slope + lens.p2 * x) + 6.0 * lens.p1 * y;
  return jacobian;
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
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

// Distance from the axis of the farthest corner (outer edge of the corner pixel), as a distorted ray.
double corner_radius(const LensModel& lens) {
  const Vec2 low = lens.pinhole.ray({-0.5, -0.5});
  const Vec2 high = lens.pinhole.ray({lens.width - 0.5, lens.height - 0.5});
  return low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm();
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

Vec2 LensModel::distort(const Vec2& ray) const {
  const double x = ray.x();
  const double y = ray.y();
  const double square = ray.squaredNorm();
  const double radial = radial_terms(*this, square).radial;
  return {x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x),
          y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y};
}

bool LensModel::undistort_pixel(const Vec2& pixel, Vec2& ray) const {
  const Vec2 distorted = pinhole.ray(pixel);
  Vec2 estimate = distorted;
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    const Vec2 residual = distort(estimate) - distorted;
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
  // Tangential terms move a corner by at most 3 |p| r²; the monotony must hold that much further out.
  const double corner = corner_radius(lens);
  const double tangential = 3.0 * (std::abs(lens.p1) + std::abs(lens.p2)) * corner * corner;
  const double largest_radius = find_unfolded_radius(lens, corner + tangential);
  if (largest_radius < 0.0 || !is_invertible_over_picture(lens, largest_radius)) {
    return StatusCode::invalid_configuration;
  }
  return StatusCode::ok;
}

}  // namespace traygauge
