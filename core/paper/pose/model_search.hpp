// RANSAC with local optimisation and a threshold that follows the best model (paper Fig. 4).
#pragma once

#include "core/base/random.hpp"
#include "core/paper/pose/relative_pose.hpp"
#include "core/paper/pose/threshold_estimator.hpp"

namespace traygauge::paper {

struct FoundModel {
  Mat3 essential = Mat3::Zero();
  double threshold_px = -1.0;  // negative: no model that is more than trivial
  int iterations = 0;
};

// Searches workspace.matches, at least five. Overwrites workspace.inliers and the distances.
FoundModel search_model(const RelativePoseParams& params, double focal_px,
                        const ThresholdEstimator& thresholds, Random& random,
                        RelativePoseWorkspace& workspace);

// Lists in workspace.inliers the matches not farther than the threshold, and returns that part.
std::span<const std::uint32_t> list_inliers(const Mat3& essential, double focal_px, double threshold_px,
                                            RelativePoseWorkspace& workspace);

// Whether so many inliers are more than a trivial model has.
bool is_non_trivial(std::size_t inliers, std::size_t matches, const RelativePoseParams& params);

}  // namespace traygauge::paper
