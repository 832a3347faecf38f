#include "firmware/evaluate/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "firmware/base/percent.hpp"
#include "firmware/evaluate/statistics.hpp"

namespace traygauge {
namespace {

constexpr double kSigmas = 2.0;

// A column a quantity, a row an estimate that states a sigma.
struct StatedSigmas {
  std::vector<double> sigma_ml;
  std::vector<double> relative_sigma;
  std::vector<double> error_ml;  // absolute
  std::vector<double> relative_error;
  std::vector<bool> is_covered;
};

double share(const std::vector<bool>& flags) {
  if (flags.empty()) return kUndefined;
  const auto count = std::count(flags.begin(), flags.end(), true);
  return kPercent * static_cast<double>(count) / static_cast<double>(flags.size());
}

// Estimates ordered by `sigma` and cut into three parts of the same size.
std::array<double, 3> coverage_by_thirds(const std::vector<double>& sigma,
                                         const std::vector<bool>& is_covered) {
  std::vector<std::size_t> order(sigma.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sigma[a] < sigma[b]; });
  std::array<double, 3> result{};
  for (std::size_t third = 0; third < result.size(); ++third) {
    std::vector<bool> own;
    for (std::size_t i = third * order.size() / 3; i < (third + 1) * order.size() / 3; ++i)
      own.push_back(is_covered[order[i]]);
    result[third] = share(own);
  }
  return result;
}

void append(const Attempt& attempt, double truth_ml, StatedSigmas& stated) {
  const double error_ml = std::abs(attempt.volume_ml - truth_ml);
  stated.sigma_ml.push_back(attempt.sigma_ml);
  // An estimate of nothing states no share; its sigma is then larger than any.
  stated.relative_sigma.push_back(attempt.sigma_ml / std::max(attempt.volume_ml, 1e-9));
  stated.error_ml.push_back(error_ml);
  stated.relative_error.push_back(error_ml / truth_ml);
  stated.is_covered.push_back(is_covered(attempt, truth_ml));
}

}  // namespace

bool is_covered(const Attempt& attempt, double truth_ml) {
  return attempt.sigma_ml > 0.0 && std::abs(attempt.volume_ml - truth_ml) <= kSigmas * attempt.sigma_ml;
}

SigmaFigures sigma_figures(const std::vector<ItemSeries>& items) {
  SigmaFigures figures;
  StatedSigmas stated;
  for (const ItemSeries& item : items) {
    for (const Attempt& attempt : item.attempts) {
      if (!attempt.is_measured) continue;
      ++figures.estimates;
      if (attempt.sigma_ml > 0.0) append(attempt, item.truth_ml, stated);
    }
  }
  if (stated.sigma_ml.empty()) return figures;
  figures.is_estimated = true;
  const auto count = static_cast<double>(stated.sigma_ml.size());
  figures.without_sigma = figures.estimates - static_cast<int>(stated.sigma_ml.size());
  figures.coverage = share(stated.is_covered) * count / figures.estimates;
  figures.coverage_by_thirds = coverage_by_thirds(stated.sigma_ml, stated.is_covered);
  figures.coverage_by_relative_thirds = coverage_by_thirds(stated.relative_sigma, stated.is_covered);
  figures.median_relative_sigma = kPercent * median(stated.relative_sigma);
  figures.rank_correlation = rank_correlation(stated.sigma_ml, stated.error_ml);
  figures.relative_rank_correlation = rank_correlation(stated.relative_sigma, stated.relative_error);
  return figures;
}

}  // namespace traygauge
