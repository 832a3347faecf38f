// Relative pose of two calibrated views from point matches: RANSAC with local optimisation and an adaptive
// inlier threshold (paper III-A-2, Fig. 4), then Levenberg-Marquardt on symmetric epipolar distances.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"
#include "core/paper/pose/inlier_threshold.hpp"
#include "core/paper/pose/match_table.hpp"

namespace traygauge::paper {

// "The paper leaves it open" marks values found by measurement on rendered and real pairs. Distances are
// those of core/paper/pose/epipolar.hpp.
struct RelativePoseParams {
  InlierThreshold threshold = InlierThreshold::false_discovery;
  double fixed_threshold_px = 1.0;   // used by `fixed`
  double max_noise_fraction = 0.03;  // p of the paper: largest share of noise among inliers
  int noise_sample = 1000;           // random matches that make Cdf_noise; the paper leaves it open
  double min_threshold_px = 0.2;     // no adaptive threshold is below this: exact matches deviate by rounding
  double max_threshold_px = 10.0;    // … or above this
  int min_inliers = 16;              // fewer inliers are a trivial model; the paper leaves it open
  double min_inlier_rate = 0.15;     // … and so is a smaller inlier rate
  bool local_optimisation = true;    // LO of Fig. 4
  int local_samples = 10;            // matches a sample in LO (paper); 5 to 32
  int local_iterations = 20;         // samples a run of LO; the paper leaves it open
  int max_restarts = 20;             // of LO at a better model, per run; the paper leaves it open
  double confidence = 0.999;         // that one sample was free of outliers
  int min_iterations = 50;
  int max_iterations = 2000;
  bool refine = true;  // Levenberg-Marquardt (Table III)
  int refine_iterations = 20;
  int refine_rounds = 3;             // refinements, each on the inliers that the one before leaves
  double robust_scale = 3.0;         // of the refinement's loss, in medians of the inliers' distances
  double min_displacement_px = 0.5;  // median between the views; below: the camera did not move
  double min_parallax_deg = 1.0;     // median of the inliers; below: the views are too close for depth
  // Of eq. (1) where hypotheses are compared: one for all of them. Too narrow, and the few points off a
  // plane, which decide, count no more than outliers; too wide, and chance outliers decide.
  double fitness_threshold_px = 8.0;
};

struct RelativePose {
  Pose second_from_first;     // translation has unit length
  double threshold_px = 0.0;  // inlier threshold that held at the end
  int inliers = 0;            // distinct ones
  int iterations = 0;
  double rms_px = 0.0;        // of the inliers' symmetric epipolar distances after refinement
  double fitness = 0.0;       // eq. (1) of the distinct matches at fitness_threshold_px, for comparisons
  double parallax_deg = 0.0;  // median of the inliers, the rotation compensated
};

struct RelativePoseWorkspace {
  MatchTable matches;  // distinct
  MatchTable noise;
  std::span<double> data_px;
  std::span<double> noise_px;
  std::span<double> log_factorials;
  std::span<std::uint32_t> inliers;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, std::size_t max_matches, std::size_t max_noise) {
    matches.allocate(arena, max_matches);
    noise.allocate(arena, max_noise);
    data_px = arena.template take<double>(max_matches);
    noise_px = arena.template take<double>(max_noise);
    log_factorials = arena.template take<double>(max_matches + 1);
    inliers = arena.template take<std::uint32_t>(max_matches);
  }
};

// invalid_configuration when a value lies outside its range.
Status validate(const RelativePoseParams& params);

// The motion behind the matches. `inliers` (same length) gets 1 for each match within the final threshold.
// Repeated matches count once. Matches beyond the workspace's capacity are judged but not used: the caller
// puts the best first. On views_identical `pose` is not touched; views_too_close still reports what was
// found.
Status estimate_relative_pose(std::span<const RayMatch> matches, double focal_px,
                              const RelativePoseParams& params, Random& random,
                              RelativePoseWorkspace& workspace, RelativePose& pose,
                              std::span<std::uint8_t> inliers);

// The same from a motion that is known roughly (that of the card, say) instead of a search. Near a plane two
// motions fit: the better hypothesis is the one with the larger RelativePose::fitness.
Status refine_relative_pose(std::span<const RayMatch> matches, double focal_px,
                            const RelativePoseParams& params, const Pose& start_second_from_first,
                            Random& random, RelativePoseWorkspace& workspace, RelativePose& pose,
                            std::span<std::uint8_t> inliers);

}  // namespace traygauge::paper
