#include "firmware/plot/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace traygauge {

double Histogram::largest_share_percent() const {
  double largest = 0.0;
  for (std::size_t bin = 0; bin < counts.size(); ++bin) largest = std::max(largest, share_percent(bin));
  return largest;
}

Histogram make_histogram(const std::vector<double>& values, double low, double high, double bin_width) {
  Histogram histogram;
  histogram.low = low;
  histogram.bin_width = bin_width;
  const auto bins =
      static_cast<std::size_t>(std::max<std::int64_t>(1, std::llround((high - low) / bin_width)));
  histogram.counts.assign(bins, 0);
  for (const double value : values) {
    ++histogram.total;
    if (!(value >= low)) {
      ++histogram.below;
    } else if (value > high) {
      ++histogram.above;
    } else {
      const auto bin = static_cast<std::size_t>((value - low) / bin_width);
      ++histogram.counts[std::min(bin, bins - 1)];
    }
  }
  return histogram;
}

}  // namespace traygauge
