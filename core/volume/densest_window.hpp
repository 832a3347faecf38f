// The mode of a histogram, as wide as a tolerance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace traygauge {

struct DensestWindow {
  std::size_t last = 0;  // bin
  std::uint32_t count = 0;
};

// The first window of `bins` neighbouring bins that holds most; it may begin before the first bin.
inline DensestWindow find_densest_window(std::span<const std::uint32_t> histogram, std::size_t bins) {
  DensestWindow densest;
  std::uint32_t inside = 0;
  for (std::size_t last = 0; last < histogram.size(); ++last) {
    inside += histogram[last];
    if (last >= bins) inside -= histogram[last - bins];
    if (inside > densest.count) densest = {last, inside};
  }
  return densest;
}

}  // namespace traygauge
