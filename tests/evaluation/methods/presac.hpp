// Preemptive RANSAC, the fitter of [24]: D. Nistér, "Preemptive RANSAC for live structure and motion
// estimation", ICCV 2003.
#pragma once

#include <span>

#include "core/paper/pose/motion_search.hpp"

namespace traygauge::tables {

// The paper tried it with "a much larger number of iterations" (V-A-3) than RANSAC, which takes 50 to 2000.
struct PresacParams {
  int hypotheses = 4000;  // M, all drawn before any is scored
  int block = 100;        // B: the hypotheses are halved each time so many more matches were scored
  double scale_px = 1.0;  // of the robust score; the fixed inlier threshold
};

// Scores all hypotheses on one match after the other, in a random order, and keeps the best
// f(i) = floor(M 2^-floor(i / B)) of them: breadth first.
class Presac final : public paper::MotionSearch {
 public:
  explicit Presac(const PresacParams& params = {}) : params_(params) {}
  bool find_motion(std::span<const RayMatch> matches, double focal_px, Random& random,
                   Pose& second_from_first) override;

 private:
  PresacParams params_;
};

// f(i) of `hypotheses` after i matches.
int kept_hypotheses(int hypotheses, int block, int scored);

}  // namespace traygauge::tables
