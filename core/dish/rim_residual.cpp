#include "core/dish/rim_residual.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/camera.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {
// Where a ray meets the plane of the edge. rho is 1 on the ellipse; the derivatives are those of
// F = rho − 1 − drop · max(0, tangent) · |grad rho|, which vanishes on the outline.
struct RimProjection::Crossing {
  Vec2 place_mm = Vec2::Zero();     // in the table frame
  Vec2 on_axes_mm = Vec2::Zero();   // along the dish's axes, from its centre
  Vec2 rho_on_axes = Vec2::Zero();  // gradient of rho along them, 1/mm
  Vec2 rho_by_place = Vec2::Zero();
  Vec2 value_by_ray = Vec2::Zero();
  double rho = 0.0;
  double gradient = 0.0;  // |grad rho|
  double tangent = 0.0;   // of the line of sight to the vertical, positive when seen from outside
  double value = 0.0;     // F
  double scale_px = 0.0;  // 1 / |dF by pixel|
};

RimProjection::RimProjection(const DishPose& place, const Pose& camera_from_table, double focal_px)
    : place_(place),
      camera_from_table_(camera_from_table),
      focal_px_(focal_px),
      camera_mm_(camera_centre_mm(camera_from_table)),
      cosine_(std::cos(place.azimuth_rad)),
      sine_(std::sin(place.azimuth_rad)) {}

bool RimProjection::cross(const Vec2& ray, Crossing& crossing) const {
  const Mat3& rotation = camera_from_table_.rotation;
  const Vec3 direction = rotation.transpose() * ray.homogeneous();
  if (!(direction.z() < -kMinDescent)) return false;
  const double depth = (place_.edge_height_mm - camera_mm_.z()) / direction.z();
  if (!(depth > 0.0)) return false;
  crossing.place_mm = camera_mm_.head<2>() + depth * direction.head<2>();
  const Vec2 offset = crossing.place_mm - place_.centre_mm;
  crossing.on_axes_mm = {cosine_ * offset.x() + sine_ * offset.y(),
                         cosine_ * offset.y() - sine_ * offset.x()};
  const Vec2 semi(0.5 * place_.size_mm[0], 0.5 * place_.size_mm[1]);
  crossing.rho = crossing.on_axes_mm.cwiseQuotient(semi).norm();
  if (!(crossing.rho > kRounding)) return false;
  crossing.rho_on_axes = crossing.on_axes_mm.cwiseQuotient(semi.cwiseAbs2()) / crossing.rho;
  crossing.rho_by_place = {cosine_ * crossing.rho_on_axes.x() - sine_ * crossing.rho_on_axes.y(),
                           sine_ * crossing.rho_on_axes.x() + cosine_ * crossing.rho_on_axes.y()};
  crossing.gradient = crossing.rho_on_axes.norm();
  crossing.tangent = crossing.rho_by_place.dot(direction.head<2>()) / (crossing.gradient * direction.z());
  const double outside = std::max(0.0, crossing.tangent);
  crossing.value = crossing.rho - 1.0 - place_.edge_drop_mm * outside * crossing.gradient;
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3 side = rotation.row(axis).transpose();
    crossing.value_by_ray[axis] =
        depth * crossing.rho_by_place.dot(side.head<2>() - direction.head<2>() * (side.z() / direction.z()));
  }
  crossing.scale_px = focal_px_ / crossing.value_by_ray.norm();
  return std::isfinite(crossing.scale_px);
}

bool RimProjection::residual(const Vec2& ray, double& residual_px) const {
  Crossing crossing;
  if (!cross(ray, crossing)) return false;
  residual_px = crossing.value * crossing.scale_px;
  return true;
}

bool RimProjection::linearise(const Vec2& ray, double& residual_px, Eigen::Matrix<double, 6, 1>& by_camera,
                              PlaceVector& by_place) const {
  Crossing at;
  if (!cross(ray, at)) return false;
  residual_px = at.value * at.scale_px;
  // The ray stays: where a point of the plane would be seen, the value there moves the other way.
  const Vec3 turned =
      camera_from_table_.rotation * Vec3(at.place_mm.x(), at.place_mm.y(), place_.edge_height_mm);
  const double depth = turned.z() + camera_from_table_.translation.z();
  const Vec3 by_point =
      -at.scale_px / depth * Vec3(at.value_by_ray.x(), at.value_by_ray.y(), -at.value_by_ray.dot(ray));
  by_camera << turned.cross(by_point), by_point;

  const double outside = std::max(0.0, at.tangent);
  by_place.head<2>() = -at.rho_by_place;
  by_place[kPlaceAzimuth] = at.rho_on_axes.x() * at.on_axes_mm.y() - at.rho_on_axes.y() * at.on_axes_mm.x();
  by_place[kPlaceHeight] = at.gradient * at.tangent;
  for (int axis = 0; axis < 2; ++axis) {
    by_place[kPlaceSize + axis] =
        -at.rho_on_axes[axis] * at.on_axes_mm[axis] / place_.size_mm[static_cast<std::size_t>(axis)];
  }
  by_place[kPlaceDrop] = -outside * at.gradient;
  by_place *= at.scale_px;
  return true;
}

}  // namespace traygauge
