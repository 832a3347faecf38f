#include "simulator/scenes/scene_poses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/render/camera_rays.hpp"

namespace traygauge {
namespace {

// From the camera's axes after a share of its motion to those in the middle of the exposure.
Eigen::Isometry3d middle_from_moved(const Photograph& view, double share) {
  const double turn_deg = view.motion_deg.norm();
  Eigen::Isometry3d pose(Eigen::Translation3d(share * view.motion_mm));
  if (turn_deg > 0.0) pose.rotate(Eigen::AngleAxisd(share * radians(turn_deg), view.motion_deg / turn_deg));
  return pose;
}

}  // namespace

double radians(double angle_deg) {
  return angle_deg * std::numbers::pi / 180.0;
}

Eigen::Isometry3d placement(const Eigen::Vector3d& centre_mm, double rotation_deg) {
  return Eigen::Translation3d(centre_mm) * Eigen::AngleAxisd(radians(rotation_deg), Eigen::Vector3d::UnitZ());
}

Eigen::Isometry3d world_from_dish(const LaidDish& dish) {
  return placement({dish.centre_mm.x(), dish.centre_mm.y(), 0.0}, dish.rotation_deg);
}

Eigen::Isometry3d world_from_card(const LaidCard& card) {
  const Eigen::Isometry3d middle =
      placement({card.centre_mm.x(), card.centre_mm.y(), card.thickness_mm}, card.rotation_deg);
  Eigen::Isometry3d flat = middle * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()) *
                           Eigen::Translation3d(-0.5 * card.width_mm, -0.5 * card.height_mm, 0.0);
  if (card.tilt_deg == 0.0) return flat;
  const Eigen::Translation3d edge(0.0, card.height_mm, card.thickness_mm);
  return flat * edge * Eigen::AngleAxisd(radians(card.tilt_deg), Eigen::Vector3d::UnitX()) * edge.inverse();
}

double card_lift_mm(const LaidCard& card, double along_mm) {
  const double share = along_mm / card.width_mm;
  return card.curl_mm * share * share;
}

Eigen::Isometry3d world_from_room(const Photograph& view) {
  return placement({view.tray_shift_mm.x(), view.tray_shift_mm.y(), 0.0}, view.tray_turn_deg).inverse();
}

Eigen::Isometry3d camera_from_world(const Photograph& view) {
  const double tilt = radians(view.tilt_deg);
  const double azimuth = radians(view.azimuth_deg);
  const Eigen::Vector3d back(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth),
                             std::cos(tilt));
  // Without roll the picture's x is the world's as nearly as the axis allows.
  Eigen::Matrix3d room_from_camera;
  room_from_camera.col(2) = -back;
  room_from_camera.col(1) = room_from_camera.col(2).cross(Eigen::Vector3d::UnitX()).normalized();
  room_from_camera.col(0) = room_from_camera.col(1).cross(room_from_camera.col(2));
  const Eigen::AngleAxisd roll(radians(view.roll_deg), Eigen::Vector3d::UnitZ());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = room_from_camera * roll.toRotationMatrix();
  pose.translation() = view.target_mm + view.distance_mm * back;
  return (world_from_room(view) * pose).inverse();
}

ViewCamera view_camera(const SceneDescription& scene, const Photograph& view) {
  const CameraDescription& lens = scene.photography.camera;
  ViewCamera camera;
  camera.width = lens.size.width;
  camera.height = lens.size.height;
  camera.fx = lens.fx_px;
  camera.fy = lens.fy_px;
  camera.cx = lens.cx_px;
  camera.cy = lens.cy_px;
  camera.distortion = lens.distortion;
  camera.aperture_mm = scene.photography.aperture_mm;
  camera.focus_mm = view.distance_mm + view.focus_error_mm;

  const Eigen::Isometry3d middle = camera_from_world(view);
  camera.moves = !view.motion_mm.isZero(0.0) || !view.motion_deg.isZero(0.0);
  camera.camera_from_world = camera.moves ? middle_from_moved(view, -0.5).inverse() * middle : middle;
  if (camera.moves) camera.camera_from_world_at_end = middle_from_moved(view, 0.5).inverse() * middle;
  return camera;
}

double relative_angle_deg(const ViewCamera& first, const ViewCamera& second,
                          const Eigen::Vector3d& point_mm) {
  const auto direction = [&](const ViewCamera& camera) {
    return (pose_in_exposure(camera, 0.5).inverse().translation() - point_mm).normalized();
  };
  const double cosine = direction(first).dot(direction(second));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

}  // namespace traygauge
