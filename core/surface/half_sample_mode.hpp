// Where most of the values lie.
#pragma once

#include <span>

namespace traygauge {

// Bickel's half-sample mode: the shortest interval that holds half of the values, then half of those, and so
// on `halvings` times or until three are left; returns the mean of what is left. One halving is the mean of
// the densest half: it withstands outliers up to half of the values and keeps most of the precision; many
// halvings follow the sharpest peak and are noisy. Sorts `values`; 0 when there are none.
double half_sample_mode(std::span<double> values, int halvings);

}  // namespace traygauge
