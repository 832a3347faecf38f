#include "firmware/drift/median_estimate.hpp"

#include <algorithm>
#include <cmath>

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
  // Of a normal distribution: the standard deviation, of the median absolute deviation; the standard error of
  // the median, of that of the mean.
  constexpr double kSigmaPerDeviation = 1.4826;
  constexpr double kMedianPerMean = 1.253;
  MedianEstimate estimate;
  estimate.count = values.size();
  estimate.value = middle_of(values);
  for (double& value : values) value = std::abs(value - estimate.value);
  estimate.sigma = kMedianPerMean * kSigmaPerDeviation * middle_of(values) /
                   std::sqrt(static_cast<double>(estimate.count));
  return estimate;
}

}  // namespace traygauge
