#include "core/tracking/height_transfer.hpp"

namespace traygauge {
namespace {

constexpr double kDifferencePx = 4.0;  // of the derivatives: small against the curvature of any lens

}  // namespace

HeightTransfer::HeightTransfer(const LensModel& first, const LensModel& second,
                               const TableCameras& camera_from_table)
    : first_(first),
      second_(second),
      table_from_first_(camera_from_table[0].rotation.transpose()),
      first_centre_mm_(camera_centre_mm(camera_from_table[0])),
      second_from_table_(camera_from_table[1]) {}

bool HeightTransfer::cast_ray(const Vec2& first_pixel, TableRay& ray) const {
  Vec2 right;
  Vec2 below;
  if (!first_.undistort_pixel(first_pixel, ray.in_camera) ||
      !first_.undistort_pixel(first_pixel + Vec2(kDifferencePx, 0.0), right) ||
      !first_.undistort_pixel(first_pixel + Vec2(0.0, kDifferencePx), below)) {
    return false;
  }
  const Vec2 dx = (right - ray.in_camera) / kDifferencePx;
  const Vec2 dy = (below - ray.in_camera) / kDifferencePx;
  ray.direction = table_from_first_ * Vec3(ray.in_camera.x(), ray.in_camera.y(), 1.0);
  ray.along_x = table_from_first_ * Vec3(dx.x(), dx.y(), 0.0);
  ray.along_y = table_from_first_ * Vec3(dy.x(), dy.y(), 0.0);
  return true;
}

bool HeightTransfer::point_at(const TableRay& ray, double height_mm, Vec3& point_mm) const {
  const double fall_mm = height_mm - first_centre_mm_.z();
  if (!(ray.direction.z() < -kMinDescent && fall_mm < 0.0)) return false;
  point_mm = first_centre_mm_ + fall_mm / ray.direction.z() * ray.direction;
  return true;
}

bool HeightTransfer::project(const Vec3& point_mm, Vec2& pixel) const {
  const Vec3 seen = second_from_table_ * point_mm;
  if (!(seen.z() > kNearMm)) return false;
  const Vec2 ray = seen.head<2>() / seen.z();
  if (!(ray.squaredNorm() < kLargestRay * kLargestRay)) return false;
  pixel = second_.pixel(ray);
  return pixel.allFinite();
}

bool HeightTransfer::transfer(const TableRay& ray, double height_mm, Vec2& pixel) const {
  Vec3 point_mm;
  return point_at(ray, height_mm, point_mm) && project(point_mm, pixel);
}

bool HeightTransfer::transfer(const TableRay& ray, double height_mm, TransferredPixel& transferred) const {
  Vec3 point_mm;
  if (!point_at(ray, height_mm, point_mm)) return false;
  const double depth = (height_mm - first_centre_mm_.z()) / ray.direction.z();
  const auto step_on_plane = [&](const Vec3& along) -> Vec3 {
    return kDifferencePx * depth * (along - along.z() / ray.direction.z() * ray.direction);
  };
  Vec2 right;
  Vec2 below;
  if (!project(point_mm, transferred.pixel) || !project(point_mm + step_on_plane(ray.along_x), right) ||
      !project(point_mm + step_on_plane(ray.along_y), below)) {
    return false;
  }
  transferred.second_from_first.col(0) = (right - transferred.pixel) / kDifferencePx;
  transferred.second_from_first.col(1) = (below - transferred.pixel) / kDifferencePx;
  return true;
}

}  // namespace traygauge
