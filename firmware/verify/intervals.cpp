#include "firmware/verify/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/evaluate/statistics.hpp"

namespace traygauge {
namespace {

constexpr int kHalvings = 200;  // as far as doubles go
constexpr int kMaxTerms = 10'000;

// Where a rising function reaches a value.
template <class Function>
double solve(Function rising, double value, double low, double high) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The regularised incomplete gamma function P(a, x) by its series (Abramowitz and Stegun 6.5.29), which needs
// more terms than it has digits only far beyond any quantile.
double gamma_share(double a, double x) {
  if (x <= 0.0) return 0.0;
  double term = 1.0 / a;
  double sum = term;
  for (int n = 1; n < kMaxTerms && term > 1e-17 * sum; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return std::min(1.0, sum * std::exp(a * std::log(x) - x - std::lgamma(a)));
}

// The regularised incomplete beta function I_x(a, b), by the continued fraction of Abramowitz and Stegun
// 26.5.8, evaluated by Lentz's method. It converges where x is below the mean; beyond, symmetry helps.
double beta_share(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  if (x > (a + 1.0) / (a + b + 2.0)) return 1.0 - beta_share(b, a, 1.0 - x);
  constexpr double kTiny = 1e-300;
  const auto kept_from_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1.0;
  double d = 1.0 / kept_from_zero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m < kMaxTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / kept_from_zero(1.0 + even * d);
    c = kept_from_zero(1.0 + even / c);
    fraction *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / kept_from_zero(1.0 + odd * d);
    c = kept_from_zero(1.0 + odd / c);
    const double factor = d * c;
    fraction *= factor;
    if (std::abs(factor - 1.0) < 1e-15) break;
  }
  const double front =
      std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  return std::exp(front) * fraction / a;
}

}  // namespace

double student_quantile(double share, double freedom) {
  if (share < 0.5) return -student_quantile(1.0 - share, freedom);
  const auto below = [&](double t) {
    return 1.0 - 0.5 * beta_share(0.5 * freedom, 0.5, freedom / (freedom + t * t));
  };
  return solve(below, share, 0.0, 1e6);
}

double chi_squared_quantile(double share, double freedom) {
  const auto below = [&](double x) { return gamma_share(0.5 * freedom, 0.5 * x); };
  return solve(below, share, 0.0, freedom + 40.0 * std::sqrt(2.0 * freedom) + 100.0);
}

std::optional<ConfidenceInterval> mean_interval(const std::vector<std::vector<double>>& groups,
                                                double confidence) {
  if (groups.empty()) return {};
  double sum = 0.0;
  double variance = 0.0;  // of the sum of means
  double by_freedom = 0.0;
  for (const std::vector<double>& group : groups) {
    if (group.size() < 2) return {};
    const double deviation = sample_deviation(group);
    const double own = deviation * deviation / static_cast<double>(group.size());
    sum += mean(group);
    variance += own;
    by_freedom += own * own / static_cast<double>(group.size() - 1);
  }
  const auto count = static_cast<double>(groups.size());
  double half = 0.0;
  if (by_freedom > 0.0) {
    const double freedom = variance * variance / by_freedom;
    half = student_quantile(0.5 * (1.0 + confidence), freedom) * std::sqrt(variance) / count;
  }
  return ConfidenceInterval{sum / count - half, sum / count + half};
}

std::optional<ConfidenceInterval> deviation_factors(int values, double confidence) {
  if (values < 2) return {};
  const double freedom = values - 1;
  const double tail = 0.5 * (1.0 - confidence);
  return ConfidenceInterval{std::sqrt(freedom / chi_squared_quantile(1.0 - tail, freedom)),
                            std::sqrt(freedom / chi_squared_quantile(tail, freedom))};
}

std::optional<ConfidenceInterval> share_interval(int hits, int trials, double confidence) {
  if (trials < 1) return {};
  const double tail = 0.5 * (1.0 - confidence);
  ConfidenceInterval interval{0.0, 1.0};
  const double misses = trials - hits;
  if (hits > 0)
    interval.low = solve([&](double p) { return beta_share(hits, misses + 1.0, p); }, tail, 0.0, 1.0);
  if (misses > 0)
    interval.high = solve([&](double p) { return beta_share(hits + 1.0, misses, p); }, 1.0 - tail, 0.0, 1.0);
  return interval;
}

}  // namespace traygauge
