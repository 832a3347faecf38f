// The half-sample mode, a robust estimate of the peak of a distribution (Bickel & Frühwirth 2006).
#pragma once

#include <span>

namespace traygauge {

// Halves the sorted sample to its densest half until at most three values remain; 0 when empty. O(n).
double half_sample_mode(std::span<const double> sorted);

}  // namespace traygauge
