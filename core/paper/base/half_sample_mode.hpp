// The half-sample mode, a robust estimate of where most values lie (Bickel & Frühwirth 2006).
#pragma once

#include <span>

namespace traygauge::paper {

struct ModeParams {
  // Rounds of halving: one finds the densest half, more follow the sharpest peak and get noisy.
  int halvings = 1;
  // The result is the mean within this many half-widths of the last interval; 3.7 half-widths of the densest
  // half are 2.5 standard deviations of normal errors. 1 keeps to the interval.
  double reach = 3.7;
};

// The shortest interval that holds half of the values, then half of those, until `halvings` rounds or three
// values; then the mean of the values near its middle. Withstands outliers up to half of the values and keeps
// nearly the precision of the mean. `sorted` ascends; 0 when it is empty. O(n).
double half_sample_mode(std::span<const double> sorted, const ModeParams& params);

}  // namespace traygauge::paper
