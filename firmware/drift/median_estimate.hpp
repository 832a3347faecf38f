// The median of a few values, and how sure it is.
#pragma once

#include <cstddef>
#include <vector>

namespace traygauge {

struct MedianEstimate {
  double value = 0.0;  // of an even count: the mean of the two in the middle
  double sigma = 0.0;  // its standard error; 0 where more than half of the values are the same
  std::size_t count = 0;
};

// All zero where there are no values. The values are finite.
MedianEstimate estimate_median(std::vector<double> values);

}  // namespace traygauge
