// Levenberg-Marquardt on the symmetric epipolar distances of the inliers (end of paper III-A-2).
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/paper/pose/match_table.hpp"

namespace traygauge::paper {

// Five degrees of freedom: a small rotation w with R ← exp(w) R, and two tangents of the unit sphere at t.
inline constexpr int kPoseParameters = 5;

// The least-squares problem. A match costs rho(d²), d its symmetric epipolar distance in pixels and
// rho(s) = s / (1 + s / scale²) (Geman and McClure): about s for good matches, never above scale².
class EpipolarProblem {
 public:
  using Equations = NormalEquations<kPoseParameters>;

  EpipolarProblem(const MatchTable& matches, std::span<const std::uint32_t> indices, double focal_px,
                  double robust_scale_px)
      : matches_(matches),
        indices_(indices),
        focal_px_(focal_px),
        inverse_squared_scale_(1.0 / (robust_scale_px * robust_scale_px)) {}

  double linearise(const Pose& pose, Equations& equations) const;
  double cost(const Pose& pose) const;
  static Pose moved(const Pose& pose, const Equations::Vector& step);

 private:
  const MatchTable& matches_;
  std::span<const std::uint32_t> indices_;
  double focal_px_;
  double inverse_squared_scale_;
};

}  // namespace traygauge::paper
