#include "core/paper/base/half_sample_mode.hpp"

#include <algorithm>
#include <cstddef>

namespace traygauge::paper {
namespace {

// The first of the shortest runs that hold half of the values.
std::span<const double> densest_half(std::span<const double> sorted) {
  const std::size_t half = (sorted.size() + 1) / 2;
  std::size_t best = 0;
  for (std::size_t i = 1; i + half <= sorted.size(); ++i) {
    if (sorted[i + half - 1] - sorted[i] < sorted[best + half - 1] - sorted[best]) best = i;
  }
  return sorted.subspan(best, half);
}

}  // namespace

double half_sample_mode(std::span<const double> sorted, const ModeParams& params) {
  if (sorted.empty()) return 0.0;
  std::span<const double> dense = sorted;
  for (int round = 0; round < params.halvings && dense.size() > 3; ++round) dense = densest_half(dense);

  const double middle = 0.5 * (dense.front() + dense.back());
  const double reach = std::max(1.0, params.reach) * 0.5 * (dense.back() - dense.front());
  const auto begin = std::lower_bound(sorted.begin(), sorted.end(), std::min(middle - reach, dense.front()));
  const auto end = std::upper_bound(sorted.begin(), sorted.end(), std::max(middle + reach, dense.back()));
  double sum = 0.0;
  for (auto value = begin; value != end; ++value) sum += *value;
  return sum / static_cast<double>(end - begin);
}

}  // namespace traygauge::paper
