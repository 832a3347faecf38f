#include "simulator/render/lens.hpp"

#include <Eigen/LU>
#include <sstream>
#include <stdexcept>

namespace traygauge {
namespace {

constexpr int kMaxIterations = 50;
constexpr double kTolerance = 1e-13;      // of x/z: less than a billionth of a pixel
constexpr double kMinSlope = 1e-3;        // determinant below which the lens counts as folded
constexpr int kFoldSteps = 64;            // between the axis and a pixel
constexpr double kFoldSpacing_px = 64.0;  // a smooth polynomial folds from its corners

}  // namespace

Lens::Lens(const ViewCamera& camera)
    : focal_px_(camera.fx, camera.fy),
      center_px_(camera.cx, camera.cy),
      k1_(camera.distortion[0]),
      k2_(camera.distortion[1]),
      p1_(camera.distortion[2]),
      p2_(camera.distortion[3]),
      k3_(camera.distortion[4]) {
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0)) {
    throw std::invalid_argument("camera: fx and fy must be positive");
  }
  if (camera.width <= 0 || camera.height <= 0) {
    throw std::invalid_argument("camera: width and height must be positive");
  }
  check_no_fold(camera.width, camera.height);
}

Eigen::Vector2d Lens::distort(const Eigen::Vector2d& direction) const {
  const double x = direction.x();
  const double y = direction.y();
  const double r2 = x * x + y * y;
  const double c = 1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_));
  return {c * x + 2.0 * p1_ * x * y + p2_ * (r2 + 2.0 * x * x),
          c * y + p1_ * (r2 + 2.0 * y * y) + 2.0 * p2_ * x * y};
}

Eigen::Matrix2d Lens::distortion_slope(const Eigen::Vector2d& direction) const {
  const double x = direction.x();
  const double y = direction.y();
  const double r2 = x * x + y * y;
  const double c = 1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_));
  const double c_by_r2 = k1_ + r2 * (2.0 * k2_ + 3.0 * r2 * k3_);
  const double mixed = 2.0 * x * y * c_by_r2 + 2.0 * p1_ * x + 2.0 * p2_ * y;
  Eigen::Matrix2d slope;
  slope << c + 2.0 * x * x * c_by_r2 + 2.0 * p1_ * y + 6.0 * p2_ * x, mixed,  //
      mixed, c + 2.0 * y * y * c_by_r2 + 6.0 * p1_ * y + 2.0 * p2_ * x;
  return slope;
}

Eigen::Vector2d Lens::pixel_of(const Eigen::Vector2d& direction) const {
  return distort(direction).cwiseProduct(focal_px_) + center_px_;
}

// Newton's method with halved steps where a full one leads further away.
Lens::Solution Lens::solve(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d wanted = (pixel - center_px_).cwiseQuotient(focal_px_);
  Solution solution{wanted, false};
  Eigen::Vector2d residual = distort(solution.direction) - wanted;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (residual.norm() <= kTolerance) {
      solution.converged = true;
      return solution;
    }
    Eigen::Vector2d step = distortion_slope(solution.direction).inverse() * residual;
    Eigen::Vector2d next_residual = distort(solution.direction - step) - wanted;
    while (!(next_residual.norm() < residual.norm()) && step.norm() > kTolerance) {
      step *= 0.5;
      next_residual = distort(solution.direction - step) - wanted;
    }
    solution.direction -= step;
    residual = next_residual;
  }
  return solution;
}

Eigen::Vector2d Lens::direction_of(const Eigen::Vector2d& pixel) const {
  const Solution solution = solve(pixel);
  if (!solution.converged)
    throw std::invalid_argument("camera: a pixel outside the picture has no direction");
  return solution.direction;
}

Eigen::Matrix2d Lens::direction_by_pixel(const Eigen::Vector2d& direction) const {
  return (focal_px_.asDiagonal() * distortion_slope(direction)).inverse();
}

bool Lens::is_one_to_one_up_to(const Eigen::Vector2d& direction) const {
  for (int i = 0; i <= kFoldSteps; ++i) {
    const double share = static_cast<double>(i) / kFoldSteps;
    const Eigen::Matrix2d slope = distortion_slope(share * direction);
    if (!(slope.determinant() > kMinSlope) || !(slope.trace() > 0.0)) return false;
  }
  return true;
}

void Lens::check_no_fold(int width, int height) const {
  const Eigen::Vector2d first(-0.5 - kMargin_px, -0.5 - kMargin_px);
  const Eigen::Vector2d last(width - 0.5 + kMargin_px, height - 0.5 + kMargin_px);
  const Eigen::Vector2d extent = last - first;
  const int columns = static_cast<int>(extent.x() / kFoldSpacing_px) + 1;
  const int rows = static_cast<int>(extent.y() / kFoldSpacing_px) + 1;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const Eigen::Vector2d pixel =
          first + Eigen::Vector2d(extent.x() * column / columns, extent.y() * row / rows);
      const Solution solution = solve(pixel);
      if (solution.converged && is_one_to_one_up_to(solution.direction)) continue;
      std::ostringstream text;
      text << "camera: the lens folds over at pixel (" << pixel.x() << ", " << pixel.y()
           << "): no single direction is seen there; take a weaker distortion";
      throw std::invalid_argument(text.str());
    }
  }
}

}  // namespace traygauge
