// Colours in classes: what is counted of a food's colours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace traygauge {

using ByteCounts = std::array<int, 256>;
using ClassTable = std::array<std::uint8_t, 256>;

// Splits the `total` bytes counted into classes of about equal counts; the class of every byte.
inline ClassTable equal_classes(const ByteCounts& counts, int total, int classes) {
  ClassTable table{};
  int below = 0;
  for (std::size_t value = 0; value < counts.size(); ++value) {
    const int middle = 2 * below + counts[value];
    table[value] =
        static_cast<std::uint8_t>(std::min(classes - 1, classes * middle / std::max(1, 2 * total)));
    below += counts[value];
  }
  return table;
}

}  // namespace traygauge
