// The symmetric epipolar distance, the measure of how well a match fits a motion.
//
// Of H&Z eq. 11.10: d1 is the distance of the first point from the epipolar line of the second, d2 the other
// way round; the distance of a match is the root of their mean square, sqrt((d1² + d2²) / 2), in pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"

namespace traygauge::paper {

// x2ᵀ E x1 and the squared normals of both epipolar lines; Real is double or an Eigen array of it.
template <class Real>
struct EpipolarTerms {
  Real constraint;
  Real squared_normal_first;
  Real squared_normal_second;
};

template <class Real>
EpipolarTerms<Real> epipolar_terms(const Mat3& e, const Real& x1, const Real& y1, const Real& x2,
                                   const Real& y2) {
  const Real line_x = e(0, 0) * x1 + e(0, 1) * y1 + e(0, 2);
  const Real line_y = e(1, 0) * x1 + e(1, 1) * y1 + e(1, 2);
  const Real line_z = e(2, 0) * x1 + e(2, 1) * y1 + e(2, 2);
  const Real back_x = e(0, 0) * x2 + e(1, 0) * y2 + e(2, 0);
  const Real back_y = e(0, 1) * x2 + e(1, 1) * y2 + e(2, 1);
  return {x2 * line_x + y2 * line_y + line_z, back_x * back_x + back_y * back_y,
          line_x * line_x + line_y * line_y};
}

// The squared distance on a picture of focal length 1 is numerator / denominator: kept apart where a
// comparison can spare the division.
template <class Real>
struct SquaredDistanceFraction {
  Real numerator;
  Real denominator;
};

template <class Real>
SquaredDistanceFraction<Real> squared_distance_fraction(const EpipolarTerms<Real>& terms) {
  return {0.5 * (terms.constraint * terms.constraint) *
              (terms.squared_normal_first + terms.squared_normal_second),
          terms.squared_normal_first * terms.squared_normal_second};
}

// Stands in for the denominator on an epipole, where every line fits and the numerator is zero, too.
inline constexpr double kMinDenominator = std::numeric_limits<double>::min();

inline double symmetric_epipolar_distance_px(const Mat3& essential, const RayMatch& match, double focal_px) {
  const auto fraction = squared_distance_fraction(epipolar_terms<double>(
      essential, match.first.x(), match.first.y(), match.second.x(), match.second.y()));
  return focal_px * std::sqrt(fraction.numerator / std::max(fraction.denominator, kMinDenominator));
}

}  // namespace traygauge::paper
