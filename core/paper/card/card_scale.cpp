#include "core/paper/card/card_scale.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/bounded_list.hpp"
#include "core/base/ransac.hpp"
#include "core/paper/base/plane_fit.hpp"

namespace traygauge::paper {

namespace {

// Appends the ratio of one pair unless the points are too near each other.
void add_ratio(const CardTrack& a, const CardTrack& b, double min_distance_mm, BoundedList<double>& ratios) {
  const double on_pattern = (a.pattern_mm - b.pattern_mm).norm();
  const double in_cloud = (a.point_in_first - b.point_in_first).norm();
  if (on_pattern >= min_distance_mm && in_cloud > 0.0) ratios.push_back(on_pattern / in_cloud);
}

std::span<const std::int32_t> list_inliers(std::span<const std::uint8_t> inliers,
                                           std::span<std::int32_t> indices) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < inliers.size() && count < indices.size(); ++i) {
    if (inliers[i] != 0) indices[count++] = static_cast<std::int32_t>(i);
  }
  return indices.first(count);
}

void collect_ratios(std::span<const CardTrack> tracks, std::span<const std::int32_t> points,
                    double min_distance_mm, Random& random, BoundedList<double>& ratios) {
  const auto track = [&](std::size_t i) -> const CardTrack& {
    return tracks[static_cast<std::size_t>(points[i])];
  };
  const std::size_t count = points.size();
  if (count < 2) return;
  if (count * (count - 1) / 2 <= ratios.capacity()) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) add_ratio(track(i), track(j), min_distance_mm, ratios);
    }
    return;
  }
  for (std::size_t draw = 0; draw < ratios.capacity(); ++draw) {
    const auto pair = sample_distinct<2>(random, count);
    add_ratio(track(pair[0]), track(pair[1]), min_distance_mm, ratios);
  }
}

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

Status estimate_scale(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, const ScaleParams& params, Random& random,
                      CardScaleWorkspace& workspace, ScaleEstimate& estimate) {
  estimate = {};
  const auto points = list_inliers(inliers, workspace.indices);
  BoundedList<double> ratios(workspace.ratios);
  collect_ratios(tracks, points, params.min_distance_fraction * card_length_mm, random, ratios);
  estimate.pairs = static_cast<int>(ratios.size());
  if (ratios.empty() || estimate.pairs < params.min_pairs) return StatusCode::scale_not_found;
  std::sort(ratios.begin(), ratios.end());
  const std::size_t count = ratios.size();
  estimate.mm_per_baseline = half_sample_mode(ratios.items(), params.mode);
  estimate.spread = (ratios[count - 1 - count / 4] - ratios[count / 4]) / estimate.mm_per_baseline;
  if (!(estimate.spread <= params.max_spread)) return StatusCode::scale_not_found;
  return {};
}

Status fit_card_plane(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, double mm_per_baseline, const CardPlaneParams& params,
                      Random& random, CardScaleWorkspace& workspace, Plane& card_plane_in_first) {
  const auto points_mm = list_points(tracks, inliers, mm_per_baseline, workspace.points_mm);
  PlaneFit fit;
  if (!fit_plane(points_mm, plane_fit_params(params, points_mm.size()), random, fit) ||
      fit.weak_spread_mm < params.min_spread_fraction * card_length_mm) {
    return StatusCode::table_not_found;
  }
  card_plane_in_first = fit.plane;
  return {};
}

}  // namespace traygauge::paper
