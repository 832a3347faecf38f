#include "core/paper/pose/inlier_threshold.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace traygauge::paper {
namespace {

constexpr double kNone = -1.0;
constexpr double kLn2 = 0.693147180559945309417;
constexpr int kLogTerms = 12;  // the series below then ends under 1e-17

// Natural logarithm from exact operations and a fixed series, because libm's last bit differs between systems
// and a threshold must not: ln m = 2 artanh((m − 1)/(m + 1)) for a mantissa m in [√½, √2).
double portable_log(double value) {
  int exponent = 0;
  double mantissa = std::frexp(value, &exponent);
  if (mantissa < 0.70710678118654752440) {
    mantissa *= 2.0;
    --exponent;
  }
  const double ratio = (mantissa - 1.0) / (mantissa + 1.0);
  const double square = ratio * ratio;
  double series = 0.0;
  for (int k = kLogTerms; k >= 0; --k) series = series * square + 1.0 / (2.0 * k + 1.0);
  return exponent * kLn2 + 2.0 * ratio * series;
}

// Moves the values up to the limit to the front and returns them.
std::span<double> keep_up_to(std::span<double> values, double limit) {
  const auto end = std::partition(values.begin(), values.end(), [&](double v) { return v <= limit; });
  return values.first(static_cast<std::size_t>(end - values.begin()));
}

void sort_ascending(std::span<double> values) {
  std::make_heap(values.begin(), values.end());
  std::sort_heap(values.begin(), values.end());
}

double log_combinations(std::span<const double> log_factorials, std::size_t n, std::size_t k) {
  return log_factorials[n] - log_factorials[k] - log_factorials[n - k];
}

}  // namespace

double false_discovery_threshold_px(std::span<double> data_px, std::span<double> noise_px,
                                    double max_noise_fraction, double max_threshold_px) {
  const auto data_count = static_cast<double>(data_px.size());
  const auto noise_count = static_cast<double>(noise_px.size());
  std::span<double> data = keep_up_to(data_px, max_threshold_px);
  std::span<double> noise = keep_up_to(noise_px, max_threshold_px);
  sort_ascending(noise);
  // From the largest distance down: the first that satisfies the bound has the largest inlier rate. Of equal
  // distances the heap yields the one that counts them all first.
  std::make_heap(data.begin(), data.end());
  std::size_t below = noise.size();
  for (std::size_t inliers = data.size(); inliers > 0; --inliers) {
    const double threshold = data[0];
    while (below > 0 && noise[below - 1] > threshold) --below;
    const double cdf_noise = static_cast<double>(below + 1) / (noise_count + 1.0);
    const double cdf_data = static_cast<double>(inliers) / data_count;
    if (cdf_noise < max_noise_fraction * cdf_data) return threshold;
    std::pop_heap(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(inliers));
  }
  return kNone;
}

double a_contrario_threshold_px(std::span<double> data_px, const AContrarioModel& model,
                                std::span<const double> log_factorials, double max_threshold_px) {
  const std::size_t n = data_px.size();
  const auto sample = static_cast<std::size_t>(model.sample_size);
  if (n <= sample || log_factorials.size() <= n) return kNone;
  std::span<double> data = keep_up_to(data_px, max_threshold_px);
  sort_ascending(data);
  const double log_tests = portable_log(model.outcomes * static_cast<double>(n - sample));
  double best_log_nfa = 0.0;
  double best = kNone;
  for (std::size_t k = sample + 1; k <= data.size(); ++k) {
    const double threshold = data[k - 1];
    if (k < data.size() && data[k] == threshold)
      continue;  // of ties only the whole group is a set of inliers
    // Distances of an exact model are rounding errors; any positive floor keeps the logarithm finite.
    const double probability = std::clamp(model.band_probability_per_px * threshold, 1e-12, 1.0);
    const double log_nfa = log_tests + log_combinations(log_factorials, n, k) +
                           log_combinations(log_factorials, k, sample) +
                           static_cast<double>(k - sample) * portable_log(probability);
    if (log_nfa < best_log_nfa) {
      best_log_nfa = log_nfa;
      best = threshold;
    }
  }
  return best;
}

void fill_log_factorials(std::span<double> values) {
  double sum = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (n > 1) sum += portable_log(static_cast<double>(n));
    values[n] = sum;
  }
}

}  // namespace traygauge::paper
