#include "core/paper/card/card_plane.hpp"

#include <algorithm>
#include <cmath>

#include "core/card/card_pose.hpp"
#include "core/card/homography.hpp"
#include "core/paper/base/plane_fit.hpp"

namespace traygauge::paper {

namespace {

// The flagged points of the sparse cloud in mm.
std::span<Vec3> list_points(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                            double mm_per_baseline, std::span<Vec3> points_mm) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < inliers.size() && count < points_mm.size(); ++i) {
    if (inliers[i] != 0) points_mm[count++] = tracks[i].point_in_first * mm_per_baseline;
  }
  return points_mm.first(count);
}

PlaneFitParams plane_fit_params(const CardPlaneParams& params, std::size_t points) {
  const auto share = static_cast<int>(std::ceil(params.min_inlier_fraction * static_cast<double>(points)));
  PlaneFitParams fit;
  fit.threshold_mm = params.inlier_mm;
  fit.min_iterations = params.min_iterations;
  fit.max_iterations = params.max_iterations;
  fit.confidence = params.confidence;
  fit.min_triangle_mm2 = 0.0;  // the spread of all inliers is checked instead
  fit.min_facing_cosine = params.min_tilt_cosine;
  fit.refits = params.refits;
  fit.min_inliers = std::max(params.min_inliers, share);
  return fit;
}

}  // namespace

Status fit_card_plane(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, double mm_per_baseline, const CardScaleParams& params,
                      Random& random, CardScaleWorkspace& workspace, Plane& card_plane_in_first) {
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
  const auto points_mm = list_points(tracks, inliers, mm_per_baseline, workspace.points_mm);
  const PlaneFitParams plane_params = plane_fit_params(params.plane, points_mm.size());
  PlaneFit fit;
  if (!fit_plane(points_mm, plane_params, random, fit) ||
      fit.weak_spread_mm < params.plane.min_spread_fraction * card_length_mm) {
    return StatusCode::table_not_found;
  }
  card_plane_in_first = fit.plane;
  return {};
}

}  // namespace traygauge::paper
