#include "simulator/render/camera_rays.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace traygauge {
namespace {

// The inverse of the tent's cumulative share: from [0, 1) to (-1, 1).
float tent(float share) {
  return share < 0.5F ? std::sqrt(2.0F * share) - 1.0F : 1.0F - std::sqrt(2.0F * (1.0F - share));
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
      middle_(pose_in_exposure(camera, 0.5).inverse()),
      center_mm_(middle_.translation().cast<float>()),
      pupil_by_mm_(middle_.linear().leftCols<2>().cast<float>()) {
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
  pixel.focus_mm = (focus_mm_ * (middle_.linear() * pixel.direction.homogeneous())).cast<float>();
  pixel.focus_by_pixel_mm =
      (focus_mm_ * (middle_.linear().leftCols<2>() * pixel.direction_by_pixel)).cast<float>();
  return pixel;
}

// Within a pixel the lens is linear to about 1e-3 px, evenly about the centre. Thin lens: every ray through
// the pupil meets the central one in the plane of focus.
Ray CameraRays::ray(const Pixel& pixel, const RaySample& sample) const {
  const Eigen::Vector2f offset_px(tent(sample.in_pixel.x()), tent(sample.in_pixel.y()));
  Eigen::Vector2f in_pupil_mm = Eigen::Vector2f::Zero();
  if (aperture_radius_mm_ > 0.0) {
    const float radius_mm = static_cast<float>(aperture_radius_mm_) * std::sqrt(sample.in_aperture.x());
    const float angle = 2.0F * std::numbers::pi_v<float> * sample.in_aperture.y();
    in_pupil_mm = {radius_mm * std::cos(angle), radius_mm * std::sin(angle)};
  }
  if (moves_) return moving_ray(pixel, sample, offset_px, in_pupil_mm);
  const Eigen::Vector3f off_center_mm = pupil_by_mm_ * in_pupil_mm;
  Ray ray;
  ray.origin_mm = center_mm_ + off_center_mm;
  ray.direction = (pixel.focus_mm + pixel.focus_by_pixel_mm * offset_px - off_center_mm).normalized();
  return ray;
}

Ray CameraRays::moving_ray(const Pixel& pixel, const RaySample& sample, const Eigen::Vector2f& offset_px,
                           const Eigen::Vector2f& in_pupil_mm) const {
  const Eigen::Vector3d direction =
      (pixel.direction + pixel.direction_by_pixel * offset_px.cast<double>()).homogeneous();
  const Eigen::Vector3d origin(static_cast<double>(in_pupil_mm.x()), static_cast<double>(in_pupil_mm.y()),
                               0.0);
  const Eigen::Isometry3d pose = world_from_camera(static_cast<double>(sample.in_exposure));
  Ray ray;
  ray.origin_mm = (pose * origin).cast<float>();
  ray.direction = (pose.linear() * (focus_mm_ * direction - origin)).normalized().cast<float>();
  return ray;
}

Ray CameraRays::central_ray(const Pixel& pixel) const {
  Ray ray;
  ray.origin_mm = middle_.translation().cast<float>();
  ray.direction = (middle_.linear() * pixel.direction.homogeneous()).cast<float>();
  return ray;
}

}  // namespace traygauge
