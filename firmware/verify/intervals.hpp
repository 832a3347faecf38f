// Confidence intervals that hold for few values. Two-sided; nothing where the values are too few.
#pragma once

#include <optional>
#include <vector>

#include "firmware/evaluate/bootstrap.hpp"

namespace traygauge {

inline constexpr double kConfidence = 0.95;

// Student's, of the mean over groups of the groups' means: each group is a stratum of its own, so what
// differs between groups is no chance. One group: the mean of its values. Degrees of freedom by Welch and
// Satterthwaite. Nothing for a group of fewer than two values.
std::optional<ConfidenceInterval> mean_interval(const std::vector<std::vector<double>>& groups,
                                                double confidence = kConfidence);

// Of a standard deviation, by the chi-squared distribution, as factors of the one that was found (n - 1).
std::optional<ConfidenceInterval> deviation_factors(int values, double confidence = kConfidence);

// Clopper and Pearson's, of a share from 0 to 1.
std::optional<ConfidenceInterval> share_interval(int hits, int trials, double confidence = kConfidence);

// Quantiles for the above, by bisection; `share` from 0 to 1, exclusive; `freedom` > 0.
double student_quantile(double share, double freedom);
double chi_squared_quantile(double share, double freedom);

}  // namespace traygauge
