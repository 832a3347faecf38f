#include "firmware/evaluate/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace traygauge {
namespace {

double sum_of_squares(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return sum;
}

double correlation(const std::vector<double>& first, const std::vector<double>& second) {
  const double first_mean = mean(first);
  const double second_mean = mean(second);
  double product = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i)
    product += (first[i] - first_mean) * (second[i] - second_mean);
  const double scale = std::sqrt(sum_of_squares(first) * sum_of_squares(second));
  return scale > 0.0 ? product / scale : kUndefined;
}

}  // namespace

double mean(const std::vector<double>& values) {
  if (values.empty()) return kUndefined;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double population_deviation(const std::vector<double>& values) {
  if (values.empty()) return kUndefined;
  return std::sqrt(sum_of_squares(values) / static_cast<double>(values.size()));
}

double sample_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return kUndefined;
  return std::sqrt(sum_of_squares(values) / static_cast<double>(values.size() - 1));
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return kUndefined;
  std::sort(values.begin(), values.end());
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double shared = 0.5 * static_cast<double>(first + 1 + end);
    for (std::size_t i = first; i < end; ++i) result[order[i]] = shared;
  }
  return result;
}

double rank_correlation(const std::vector<double>& first, const std::vector<double>& second) {
  if (first.size() != second.size() || first.size() < 2) return kUndefined;
  return correlation(ranks(first), ranks(second));
}

}  // namespace traygauge
