// Relative pose of two calibrated views from point matches: RANSAC with local optimisation and an adaptive
// inlier threshold (paper III-A-2, Fig. 4), then Levenberg-Marquardt on symmetric epipolar distances.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/geometry.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"

namespace traygauge {

// Corresponding rays (normalised, undistorted image points) of the two views.
struct RayMatch {
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
};

enum class InlierThreshold : std::uint8_t {
  fixed,            // one distance for all pairs
  a_contrario,      // Moisan, Moulon, Monasse [30]
  false_discovery,  // the paper's: bound on the share of random matches among the inliers
};

struct RelativePoseParams {
  InlierThreshold threshold = InlierThreshold::false_discovery;
  double fixed_threshold_px = 1.0;  // symmetric epipolar distance; used by `fixed`
  double max_noise_share = 0.03;    // p of the paper: largest share of noise among inliers
  int noise_sample = 1000;          // random matches that make Cdf_noise; the paper leaves it open
  double max_threshold_px = 10.0;   // no adaptive threshold exceeds this
  int min_inliers = 16;             // fewer inliers are a trivial model; the paper leaves it open
  double min_inlier_rate = 0.15;    // … and so is a smaller inlier rate
  bool local_optimisation = true;   // LO of Fig. 4
  int local_samples = 10;           // matches a sample in LO (paper)
  int local_iterations = 20;        // samples a run of LO; the paper leaves it open
  double confidence = 0.999;        // that one sample was free of outliers
  int min_iterations = 50;
  int max_iterations = 2000;
  bool refine = true;  // Levenberg-Marquardt (Table III)
  int refine_iterations = 20;
};

struct RelativePose {
  Pose second_from_first;     // translation has unit length
  double threshold_px = 0.0;  // inlier threshold that held at the end
  int inliers = 0;
  int iterations = 0;
  double rms_px = 0.0;  // of the inliers' symmetric epipolar distances after refinement
};

struct RelativePoseWorkspace;

}  // namespace traygauge
