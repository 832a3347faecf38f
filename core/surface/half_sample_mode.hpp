// Where most of the values lie.
#pragma once

#include <span>

namespace traygauge {

struct ModeParams {
  // Rounds of halving: one finds the densest half, more follow the sharpest peak and get noisy.
  int halvings = 1;
  // The result is the mean within this many half-widths of the last interval; 3.7 half-widths of the densest
  // half are 2.5 standard deviations of normal errors. 1 keeps to the interval.
  double reach = 3.7;
};

// Bickel's half-sample mode: the shortest interval that holds half of the values, then half of those, until
// `halvings` rounds or three values; then the mean of the values near its middle. Withstands outliers up to
// half of the values and keeps nearly the precision of the mean. Sorts `values`; 0 when there are none.
double half_sample_mode(std::span<double> values, const ModeParams& params);

}  // namespace traygauge
