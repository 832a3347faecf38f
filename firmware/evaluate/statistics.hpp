// Statistics of plain numbers. What is not defined (a median of nothing, say) is NaN.
#pragma once

#include <limits>
#include <vector>

namespace traygauge {

inline constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

double mean(const std::vector<double>& values);

// Standard deviation: divided by n, as in the paper's equation (3), or by n - 1.
double population_deviation(const std::vector<double>& values);
double sample_deviation(const std::vector<double>& values);

// Linear between order statistics (R's type 7); `share` from 0 to 1.
double quantile(std::vector<double> values, double share);
double median(std::vector<double> values);

// 1 for the smallest; equal values share the mean of their ranks.
std::vector<double> ranks(const std::vector<double>& values);

// Spearman's: Pearson's correlation of the ranks. NaN when one of the two does not vary.
double rank_correlation(const std::vector<double>& first, const std::vector<double>& second);

}  // namespace traygauge
