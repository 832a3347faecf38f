#include "core/surface/half_sample_mode.hpp"

#include <algorithm>
#include <cstddef>

namespace traygauge {

double half_sample_mode(std::span<double> values, int halvings) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  for (int round = 0; round < halvings && values.size() > 3; ++round) {
    const std::size_t half = (values.size() + 1) / 2;
    std::size_t best = 0;
    for (std::size_t i = 1; i + half <= values.size(); ++i) {
      if (values[i + half - 1] - values[i] < values[best + half - 1] - values[best]) best = i;
    }
    values = values.subspan(best, half);
  }
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace traygauge
