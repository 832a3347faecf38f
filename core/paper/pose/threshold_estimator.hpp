// The three ways to set the inlier threshold, behind one question: how far may an inlier of this model lie?
#pragma once

#include "core/base/random.hpp"
#include "core/paper/pose/relative_pose.hpp"

namespace traygauge::paper {

class ThresholdEstimator {
 public:
  // Uses workspace.matches; fills what the chosen threshold needs: random matches of existing points, or
  // tables.
  ThresholdEstimator(const RelativePoseParams& params, double focal_px, Random& random,
                     RelativePoseWorkspace& workspace);

  // Negative when the model stands out from noise at no distance.
  double threshold_px(const Mat3& essential) const;

 private:
  void draw_noise(Random& random);
  void measure_area();

  const RelativePoseParams& params_;
  double focal_px_;
  RelativePoseWorkspace& workspace_;
  AContrarioModel a_contrario_;
};

}  // namespace traygauge::paper
