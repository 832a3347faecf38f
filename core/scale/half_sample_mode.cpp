#include "core/scale/half_sample_mode.hpp"

namespace traygauge {

namespace {

// The first of the narrowest runs of `length` values.
std::span<const double> narrowest_run(std::span<const double> sorted, std::size_t length) {
  std::size_t best = 0;
  for (std::size_t i = 1; i + length <= sorted.size(); ++i) {
    if (sorted[i + length - 1] - sorted[i] < sorted[best + length - 1] - sorted[best]) best = i;
  }
  return sorted.subspan(best, length);
}

}  // namespace

double half_sample_mode(std::span<const double> sorted) {
  if (sorted.empty()) return 0.0;
  while (sorted.size() > 3) sorted = narrowest_run(sorted, (sorted.size() + 1) / 2);
  if (sorted.size() == 1) return sorted[0];
  if (sorted.size() == 2) return 0.5 * (sorted[0] + sorted[1]);
  const double below = sorted[1] - sorted[0];
  const double above = sorted[2] - sorted[1];
  if (below == above) return sorted[1];
  return below < above ? 0.5 * (sorted[0] + sorted[1]) : 0.5 * (sorted[1] + sorted[2]);
}

}  // namespace traygauge
