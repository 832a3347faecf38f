// Counts of numbers by equal bins.
#pragma once

#include <cstddef>
#include <vector>

namespace traygauge {

struct Histogram {
  double low = 0.0;
  double bin_width = 1.0;
  std::vector<int> counts;
  int below = 0;  // of the first bin
  int above = 0;  // of the last one
  int total = 0;  // these included

  double edge(std::size_t bin) const { return low + bin_width * static_cast<double>(bin); }
  double share_percent(std::size_t bin) const { return total > 0 ? 100.0 * counts[bin] / total : 0.0; }
  double largest_share_percent() const;
};

// Bins from `low` to `high`; a value on an edge belongs to the bin above it, the value `high` to the last
// one.
Histogram make_histogram(const std::vector<double>& values, double low, double high, double bin_width);

}  // namespace traygauge
