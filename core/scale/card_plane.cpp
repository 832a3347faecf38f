#include "core/scale/card_plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/ransac.hpp"
#include "core/scale/card_pose.hpp"
#include "core/scale/homography.hpp"

namespace traygauge {

namespace {

constexpr std::size_t kSample = 3;

// The flagged points of the sparse cloud in mm.
struct CardPoints {
  std::span<const CardTrack> tracks;
  std::span<const std::int32_t> indices;
  double mm_per_baseline;

  std::size_t size() const { return indices.size(); }
  Vec3 operator[](std::size_t i) const {
    return tracks[static_cast<std::size_t>(indices[i])].point_in_first * mm_per_baseline;
  }
};

Plane plane_towards_camera(const Vec3& normal, const Vec3& point) {
  const Vec3 up = normal.dot(point) < 0.0 ? normal : Vec3(-normal);
  return {up, up.dot(point)};
}

bool plane_through(const Vec3& a, const Vec3& b, const Vec3& c, Plane& plane) {
  const Vec3 normal = (b - a).cross(c - a);
  const double length = normal.norm();
  if (!(length > 0.0)) return false;
  plane = plane_towards_camera(normal / length, a);
  return true;
}

int count_inliers(const CardPoints& points, const Plane& plane, double inlier_mm) {
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    count += std::abs(plane.height(points[i])) <= inlier_mm ? 1 : 0;
  return count;
}

// Total least squares over the points near `plane`; false when they lie nearly on a line.
bool refit_plane(const CardPoints& points, double inlier_mm, double min_spread_mm, Plane& plane) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(plane.height(points[i])) > inlier_mm) continue;
    sum += points[i];
    count += 1.0;
  }
  if (count < 3.0) return false;
  const Vec3 centroid = sum / count;
  Mat3 scatter = Mat3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(plane.height(points[i])) > inlier_mm) continue;
    const Vec3 offset = points[i] - centroid;
    scatter.noalias() += offset * offset.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(scatter / count);  // eigenvalues ascend
  if (std::sqrt(std::max(0.0, eigen.eigenvalues()(1))) < min_spread_mm) return false;
  plane = plane_towards_camera(eigen.eigenvectors().col(0), centroid);
  return true;
}

Status plane_from_points(const CardPoints& points, double card_length_mm, const CardPlaneParams& params,
                         Random& random, Plane& plane) {
  const auto share =
      static_cast<int>(std::ceil(params.min_inlier_share * static_cast<double>(points.size())));
  const int needed = std::max({params.min_inliers, static_cast<int>(kSample), share});
  if (static_cast<int>(points.size()) < needed) return StatusCode::table_not_found;
  int best = 0;
  IterationBound bound(params.confidence, params.min_iterations, params.max_iterations);
  for (; bound.proceed(); bound.count_iteration()) {
    const auto sample = sample_distinct<kSample>(random, points.size());
    Plane hypothesis;
    if (!plane_through(points[sample[0]], points[sample[1]], points[sample[2]], hypothesis)) continue;
    const int count = count_inliers(points, hypothesis, params.inlier_mm);
    const Vec3 sight = points[sample[0]].normalized();
    if (count <= best || -hypothesis.normal.dot(sight) < params.min_tilt_cosine) continue;
    best = count;
    plane = hypothesis;
    bound.update(static_cast<double>(best) / static_cast<double>(points.size()), kSample);
  }
  const double min_spread_mm = params.min_spread_share * card_length_mm;
  if (best < needed || !refit_plane(points, params.inlier_mm, min_spread_mm, plane)) {
    return StatusCode::table_not_found;
  }
  return {};
}

}  // namespace

Status fit_card_plane(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, double mm_per_baseline, const CardParams& params, Random& random,
                      CardWorkspace& workspace, Plane& card_plane_in_first) {
  if (params.plane.source == CardPlaneSource::absolute_pose) {
    Mat3 homography;
    CardPose pose;
    if (!fit_homography(tracks, inliers, &CardTrack::first, homography) ||
        !card_pose_from_homography(homography, tracks, inliers, &CardTrack::first, params.pose, pose)) {
      return StatusCode::table_not_found;
    }
    card_plane_in_first = plane_from_card_pose(pose.camera_from_card);
    return {};
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < inliers.size() && count < workspace.indices.size(); ++i) {
    if (inliers[i] != 0) workspace.indices[count++] = static_cast<std::int32_t>(i);
  }
  const CardPoints points{tracks, workspace.indices.first(count), mm_per_baseline};
  return plane_from_points(points, card_length_mm, params.plane, random, card_plane_in_first);
}

}  // namespace traygauge
