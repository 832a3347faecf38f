// Photographs of real things with known cameras as the dense stages see them, and points of their scenes from
// OpenCV's features in many views.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/stereo/plane_rectification.hpp"
#include "core/stereo/surface_grid.hpp"
#include "tests/support/capture_truth.hpp"

namespace traygauge::test {

struct Photograph {
  TrueView view;  // its world is the table frame, mm
  cv::Mat1b gray;
  cv::Mat1b labels;

  StoredView stored() const;
  Vec2 pixel_of(const Vec3& point_mm) const;  // in the stored picture
};

// The world's lengths are multiplied by `mm_per_unit` before `table_from_world` moves it. No labels.
Photograph read_photograph(const TrueView& view, double mm_per_unit, const Pose& table_from_world);

struct ScenePoint {
  Vec2 ray = Vec2::Zero();  // in the reference, z = 1
  Vec3 point_mm = Vec3::Zero();
};

// SIFT points of photograph `reference` found in at least three others, each triangulated from all of its
// sightings, which lie within `max_residual_px` of it.
std::vector<ScenePoint> triangulate_features(const std::vector<Photograph>& photographs,
                                             std::size_t reference, double max_residual_px);

// Depth along the optical axis at the pixels of `seen` that have a matched sample of its grid within
// `reach_px`, about the samples' distance; 0 elsewhere.
cv::Mat1f depth_map(const SurfaceGrid& grid, const Photograph& seen, int reach_px);

struct SurfaceDeviation {
  int compared = 0;
  int missing = 0;  // points, or depths of the first map, that have no depth to be compared with
  double median_px = 0.0;
  double percentile90_px = 0.0;
  double median_mm = 0.0;
  double bias_mm = 0.0;  // median, signed
};

// Depths of `seen` against the scene's points: along the line of sight, and in the picture of `other`.
SurfaceDeviation compare_depth(const cv::Mat1f& depth_mm, const Photograph& seen, const Photograph& other,
                               const std::vector<ScenePoint>& points);
// Two depth maps of the same photograph.
SurfaceDeviation compare_depth(const cv::Mat1f& depth_mm, const cv::Mat1f& reference_mm,
                               const Photograph& seen, const Photograph& other);

}  // namespace traygauge::test
