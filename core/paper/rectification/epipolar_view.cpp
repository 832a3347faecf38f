#include "core/paper/rectification/epipolar_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace traygauge::paper {
namespace {

Vec3 project(const PinholeCamera& camera, const Vec3& direction) {
  return {camera.fx_px * direction.x() + camera.cx_px * direction.z(),
          camera.fy_px * direction.y() + camera.cy_px * direction.z(), direction.z()};
}

}  // namespace

Vec3 EpipolarView::ray(const Vec2& pixel) const {
  const Vec2 ray = camera.ray(pixel);
  return {ray.x(), ray.y(), 1.0};
}

Vec3 EpipolarView::epipole() const {
  return project(camera, baseline);
}

double EpipolarView::angle(const Vec2& pixel) const {
  const Vec3 direction = ray(pixel);
  return std::atan2(right_angle.dot(direction), zero_angle.dot(direction));
}

double EpipolarView::distance_along(const Vec2& pixel) const {
  const Vec3 e = epipole();
  const Vec2 e_px = e.head<2>();
  const double sum = (pixel * e.z() - e_px).norm() + (anchor_px * e.z() - e_px).norm();
  if (sum == 0.0) return 0.0;
  return (pixel - anchor_px).dot((pixel + anchor_px) * e.z() - 2.0 * e_px) / sum;
}

double EpipolarView::distance_along_at(double distance_px) const {
  const Vec3 e = epipole();
  const double anchor_distance = (anchor_px * e.z() - e.head<2>()).norm();
  return (distance_px * std::abs(e.z()) - anchor_distance) / e.z();
}

bool EpipolarView::half_line(double angle, double first, RectifiedLine& line) const {
  const Vec3 across = std::cos(angle) * zero_angle + std::sin(angle) * right_angle;
  const Vec3 b = epipole();
  const Vec3 m = project(camera, across);
  const Vec2 direction = m.head<2>() * b.z() - b.head<2>() * m.z();
  // Turning the anchor about the baseline meets the half-line near the arc of equal distance.
  const Vec3 anchor = ray(anchor_px).normalized();
  const double along = baseline.dot(anchor);
  const Vec3 turned = along * b + baseline.cross(anchor).norm() * m;
  const double length = direction.norm();
  if (!(turned.z() > 0.0) || !(length > 0.0)) return false;
  const Vec2 foot = turned.head<2>() / turned.z();
  line.step = direction / length;
  line.origin = foot + (first - distance_along(foot)) * line.step;
  return true;
}

double EpipolarView::angle_per_pixel(double angle, const Eigen::AlignedBox2d& box) const {
  const Vec3 across = std::cos(angle) * zero_angle + std::sin(angle) * right_angle;
  const Vec3 normal = std::cos(angle) * right_angle - std::sin(angle) * zero_angle;
  // The gradient of the angle is normal / (across · ray), and across · ray is linear in the pixel.
  const std::array corners = {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                              Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight};
  double outermost = 0.0;
  for (const auto corner : corners) outermost = std::max(outermost, across.dot(ray(box.corner(corner))));
  return std::hypot(normal.x() / camera.fx_px, normal.y() / camera.fy_px) / outermost;
}

}  // namespace traygauge::paper
