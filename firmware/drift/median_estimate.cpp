#include "firmware/drift/median_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/median.hpp"

namespace traygauge {
namespace {

// Changes the order of the values, of which there is at least one.
double middle_of(std::vector<double>& values) {
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  if (values.size() % 2 == 1) return *upper;
  return (*std::max_element(values.begin(), upper) + *upper) / 2.0;
}

}  // namespace

MedianEstimate estimate_median(std::vector<double> values) {
  if (values.empty()) return {};
  // Of a normal distribution: the standard error of the median over that of the mean, sqrt(π / 2).
  constexpr double kMedianPerMean = 1.253;
  MedianEstimate estimate;
  estimate.count = values.size();
  estimate.value = middle_of(values);
  for (double& value : values) value = std::abs(value - estimate.value);
  estimate.sigma =
      kMedianPerMean * kMedianToSigma * middle_of(values) / std::sqrt(static_cast<double>(estimate.count));
  return estimate;
}

}  // namespace traygauge
