// The median by its definition: what the program's is compared with.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/drift/median_estimate.hpp"

namespace traygauge::test {

inline double sorted_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

inline MedianEstimate sorted_estimate(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double median = sorted_median(values);
  std::vector<double> deviations;
  deviations.reserve(values.size());
  for (const double value : values) deviations.push_back(std::abs(value - median));
  const double error =
      1.253 * 1.4826 * sorted_median(deviations) / std::sqrt(static_cast<double>(values.size()));
  return {median, error, values.size()};
}

}  // namespace traygauge::test
