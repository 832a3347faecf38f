#include "simulator/render/camera_rays.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace traygauge {
namespace {

// The inverse of the tent's cumulative share: from [0, 1) to (-1, 1).
double tent(double share) {
  return share < 0.5 ? std::sqrt(2.0 * share) - 1.0 : 1.0 - std::sqrt(2.0 * (1.0 - share));
}

}  // namespace

Eigen::Isometry3d pose_in_exposure(const ViewCamera& camera, double share) {
  if (!camera.moves) return camera.camera_from_world;
  const Eigen::Isometry3d start = camera.camera_from_world.inverse();
  const Eigen::Isometry3d end = camera.camera_from_world_at_end.inverse();
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(start.linear()).slerp(share, Eigen::Quaterniond(end.linear()));
  Eigen::Isometry3d world_from_camera = Eigen::Isometry3d::Identity();
  world_from_camera.linear() = turn.toRotationMatrix();
  world_from_camera.translation() = (1.0 - share) * start.translation() + share * end.translation();
  return world_from_camera.inverse();
}

CameraRays::CameraRays(const ViewCamera& camera)
    : lens_(camera),
      pixel_width_(static_cast<float>(1.0 / camera.fx)),
      aperture_radius_mm_(0.5 * camera.aperture_mm),
      focus_mm_(camera.focus_mm),
      moves_(camera.moves),
      middle_(pose_in_exposure(camera, 0.5).inverse()) {
  if (!(camera.aperture_mm >= 0.0)) throw std::invalid_argument("camera: the aperture must not be negative");
  if (!(camera.focus_mm > 0.0)) throw std::invalid_argument("camera: the focus must be before the camera");
  const Eigen::Isometry3d start = camera.camera_from_world.inverse();
  const Eigen::Isometry3d end =
      (moves_ ? camera.camera_from_world_at_end : camera.camera_from_world).inverse();
  center_start_ = start.translation();
  center_end_ = end.translation();
  turn_start_ = Eigen::Quaterniond(start.linear());
  turn_end_ = Eigen::Quaterniond(end.linear());
}

Eigen::Isometry3d CameraRays::world_from_camera(double share) const {
  if (!moves_) return middle_;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn_start_.slerp(share, turn_end_).toRotationMatrix();
  pose.translation() = (1.0 - share) * center_start_ + share * center_end_;
  return pose;
}

CameraRays::Pixel CameraRays::pixel(int x, int y) const {
  Pixel pixel;
  pixel.direction = lens_.direction_of({x, y});
  pixel.direction_by_pixel = lens_.direction_by_pixel(pixel.direction);
  return pixel;
}

// Within a pixel the lens is linear to about 1e-3 px, evenly about the centre.
Ray CameraRays::ray(const Pixel& pixel, const RaySample& sample) const {
  const Eigen::Vector2d offset_px(tent(sample.in_pixel.x()), tent(sample.in_pixel.y()));
  const Eigen::Vector3d direction = (pixel.direction + pixel.direction_by_pixel * offset_px).homogeneous();
  // Thin lens: every ray through the pupil meets the central one in the plane of focus.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (aperture_radius_mm_ > 0.0) {
    const double radius = aperture_radius_mm_ * std::sqrt(static_cast<double>(sample.in_aperture.x()));
    const double angle = 2.0 * std::numbers::pi * sample.in_aperture.y();
    origin = {radius * std::cos(angle), radius * std::sin(angle), 0.0};
  }
  const Eigen::Vector3d along = focus_mm_ * direction - origin;
  const Eigen::Isometry3d pose = world_from_camera(sample.in_exposure);
  Ray ray;
  ray.origin_mm = (pose * origin).cast<float>();
  ray.direction = (pose.linear() * along).normalized().cast<float>();
  return ray;
}

Ray CameraRays::central_ray(const Pixel& pixel) const {
  Ray ray;
  ray.origin_mm = middle_.translation().cast<float>();
  ray.direction = (middle_.linear() * pixel.direction.homogeneous()).cast<float>();
  return ray;
}

}  // namespace traygauge
