#include "core/card/card_pose.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "core/geometry/levenberg_marquardt.hpp"

namespace traygauge {

namespace {

Vec3 on_card(const CardTrack& track) {
  return {track.pattern_mm.x(), track.pattern_mm.y(), 0.0};
}

// Reprojection errors of the flagged tracks in one view. Six parameters: a small rotation about the camera's
// axes and a translation.
class ReprojectionProblem {
 public:
  using Equations = NormalEquations<6>;

  ReprojectionProblem(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers, CardView view)
      : tracks_(tracks), inliers_(inliers), view_(view) {}

  // Infinite when a point lies behind the camera.
  double cost(const Pose& pose) const {
    double cost = 0.0;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (inliers_[i] == 0) continue;
      const Vec3 point = pose * on_card(tracks_[i]);
      if (!(point.z() > 0.0)) return std::numeric_limits<double>::infinity();
      cost += (point.head<2>() / point.z() - tracks_[i].*view_).squaredNorm();
    }
    return cost;
  }

  double linearise(const Pose& pose, Equations& equations) const {
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (inliers_[i] == 0) continue;
      const Vec3 turned = pose.rotation * on_card(tracks_[i]);
      const Vec3 point = turned + pose.translation;
      const Vec2 projected = point.head<2>() / point.z();
      for (int row = 0; row < 2; ++row) {
        const Vec3 by_point = (Vec3::Unit(row) - projected(row) * Vec3::UnitZ()) / point.z();
        Equations::Vector jacobian;
        jacobian << turned.cross(by_point), by_point;
        equations.add(projected(row) - (tracks_[i].*view_)(row), jacobian);
      }
    }
    return cost(pose);
  }

  static Pose moved(const Pose& pose, const Equations::Vector& step) {
    return {rotation_about(step.head<3>()) * pose.rotation, pose.translation + step.tail<3>()};
  }

 private:
  std::span<const CardTrack> tracks_;
  std::span<const std::uint8_t> inliers_;
  CardView view_;
};

// Moves `pose` to the nearest optimum; returns the cost reached.
double refine(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers, CardView view,
              Pose& pose) {
  const ReprojectionProblem problem(tracks, inliers, view);
  return minimise<kPoseParameters>(problem, {}, pose).cost;
}

}  // namespace

bool pose_from_homography(const Mat3& pattern_from_ray, Pose& camera_from_card) {
  const Mat3 sides = pattern_from_ray.inverse();
  const double scale = 0.5 * (sides.col(0).norm() + sides.col(1).norm());
  if (!sides.allFinite() || !(scale > 0.0)) return false;
  // The right angle nearest to both sides shares their bisectors.
  const Vec3 x = sides.col(0).normalized();
  const Vec3 y = sides.col(1).normalized();
  const Vec3 sum = (x + y).normalized();
  const Vec3 difference = (x - y).normalized();
  camera_from_card.rotation.col(0) = (sum + difference).normalized();
  camera_from_card.rotation.col(1) = (sum - difference).normalized();
  camera_from_card.rotation.col(2) = camera_from_card.rotation.col(0).cross(camera_from_card.rotation.col(1));
  camera_from_card.translation = sides.col(2) / scale;
  return camera_from_card.rotation.allFinite() && camera_from_card.translation.z() > 0.0;
}

Mat3 homography_from_pose(const Pose& camera_from_card) {
  Mat3 ray_from_pattern;
  ray_from_pattern << camera_from_card.rotation.col(0), camera_from_card.rotation.col(1),
      camera_from_card.translation;
  return ray_from_pattern.inverse();
}

bool card_pose_from_homography(const Mat3& pattern_from_ray, std::span<const CardTrack> tracks,
                               std::span<const std::uint8_t> inliers, CardView view,
                               const CardPoseParams& params, CardPose& pose) {
  Pose start;
  if (!pose_from_homography(pattern_from_ray, start)) return false;
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (inliers[i] == 0) continue;
    sum += on_card(tracks[i]);
    count += 1.0;
  }
  if (count < 4.0) return false;
  pose.camera_from_card = start;
  double cost = refine(tracks, inliers, view, pose.camera_from_card);
  pose.ambiguity_ratio = 0.0;
  if (params.try_flipped) {
    Pose other = mirrored_pose(pose.camera_from_card, sum / count);
    double other_cost = refine(tracks, inliers, view, other);
    if (other_cost < cost) {
      std::swap(pose.camera_from_card, other);
      std::swap(cost, other_cost);
    }
    pose.ambiguity_ratio =
        cost > 0.0 ? std::sqrt(other_cost / cost) : std::numeric_limits<double>::infinity();
  }
  pose.rms_ray = std::sqrt(cost / count);
  return std::isfinite(cost);
}

Pose mirrored_pose(const Pose& camera_from_card, const Vec3& centre_on_card) {
  const Vec3 centre = camera_from_card * centre_on_card;
  const Vec3 sight = centre.normalized();
  Pose other;
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3 side = camera_from_card.rotation.col(axis);
    other.rotation.col(axis) = side - 2.0 * sight.dot(side) * sight;
  }
  other.rotation.col(2) = other.rotation.col(0).cross(other.rotation.col(1));
  other.translation = centre - other.rotation * centre_on_card;
  return other;
}

Pose motion_from_card(const Pose& first_from_card, const Pose& second_from_card) {
  const Mat3 rotation = second_from_card.rotation * first_from_card.rotation.transpose();
  return {rotation, second_from_card.translation - rotation * first_from_card.translation};
}

Plane plane_from_card_pose(const Pose& camera_from_card) {
  const Vec3 normal = -camera_from_card.rotation.col(2);
  return {normal, normal.dot(camera_from_card.translation)};
}

}  // namespace traygauge
