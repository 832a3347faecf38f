#include "core/scale/card_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace traygauge {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr double kFirstDamping = 1e-6;
constexpr double kDampingFactor = 10.0;  // Levenberg-Marquardt's usual factor between steps

Vec3 on_card(const CardTrack& track) {
  return {track.pattern_mm.x(), track.pattern_mm.y(), 0.0};
}

// Sum of squared reprojection errors; infinite when a point lies behind the camera.
double cost_of(const Pose& pose, std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
               CardView view) {
  double cost = 0.0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (inliers[i] == 0) continue;
    const Vec3 point = pose * on_card(tracks[i]);
    if (!(point.z() > 0.0)) return std::numeric_limits<double>::infinity();
    cost += (point.head<2>() / point.z() - tracks[i].*view).squaredNorm();
  }
  return cost;
}

// Normal equations for a small rotation (first three) about the camera's axes and a translation.
void linearise(const Pose& pose, std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
               CardView view, Mat6& matrix, Vec6& right) {
  matrix.setZero();
  right.setZero();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (inliers[i] == 0) continue;
    const Vec3 turned = pose.rotation * on_card(tracks[i]);
    const Vec3 point = turned + pose.translation;
    const Vec2 projected = point.head<2>() / point.z();
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1.0, 0.0, -projected.x(), 0.0, 1.0, -projected.y();
    by_point /= point.z();
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian << -by_point * skew(turned), by_point;
    matrix.noalias() += jacobian.transpose() * jacobian;
    right.noalias() += jacobian.transpose() * (tracks[i].*view - projected);
  }
}

Pose moved(const Pose& pose, const Vec6& step) {
  const Vec3 turn = step.head<3>();
  const double angle = turn.norm();
  const Mat3 rotation =
      angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3::Identity();
  return {rotation * pose.rotation, pose.translation + step.tail<3>()};
}

// Levenberg-Marquardt from `pose`; returns the cost reached.
double refine(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers, CardView view,
              const CardPoseParams& params, Pose& pose) {
  double cost = cost_of(pose, tracks, inliers, view);
  double damping = kFirstDamping;
  Mat6 matrix;
  Vec6 right;
  linearise(pose, tracks, inliers, view, matrix, right);
  for (int iteration = 0; iteration < params.iterations; ++iteration) {
    Mat6 damped = matrix;
    damped.diagonal() *= 1.0 + damping;
    const Vec6 step = damped.ldlt().solve(right);
    const double length = step.head<3>().norm() + step.tail<3>().norm() / pose.translation.norm();
    if (!(length > params.min_step)) break;
    const Pose candidate = moved(pose, step);
    const double candidate_cost = cost_of(candidate, tracks, inliers, view);
    if (candidate_cost < cost) {
      pose = candidate;
      cost = candidate_cost;
      damping /= kDampingFactor;
      linearise(pose, tracks, inliers, view, matrix, right);
    } else {
      damping *= kDampingFactor;
    }
  }
  return cost;
}

// The pose that weak perspective cannot tell from this one: depths along the line of sight to the card's
// points' centroid mirrored.
Pose flipped(const Pose& pose, const Vec3& centre_on_card) {
  const Vec3 centre = pose * centre_on_card;
  const Vec3 sight = centre.normalized();
  Pose other;
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3 side = pose.rotation.col(axis);
    other.rotation.col(axis) = side - 2.0 * sight.dot(side) * sight;
  }
  other.rotation.col(2) = other.rotation.col(0).cross(other.rotation.col(1));
  other.translation = centre - other.rotation * centre_on_card;
  return other;
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
  double cost = refine(tracks, inliers, view, params, pose.camera_from_card);
  pose.ambiguity_ratio = 0.0;
  if (params.try_flipped) {
    Pose other = flipped(pose.camera_from_card, sum / count);
    double other_cost = refine(tracks, inliers, view, params, other);
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

Pose motion_from_card(const Pose& first_from_card, const Pose& second_from_card) {
  const Mat3 rotation = second_from_card.rotation * first_from_card.rotation.transpose();
  return {rotation, second_from_card.translation - rotation * first_from_card.translation};
}

Plane plane_from_card_pose(const Pose& camera_from_card) {
  const Vec3 normal = -camera_from_card.rotation.col(2);
  return {normal, normal.dot(camera_from_card.translation)};
}

}  // namespace traygauge
