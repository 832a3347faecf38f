// Colours in classes: what is counted of a food's colours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/units.hpp"
#include "core/segmentation/dish_raster.hpp"

namespace traygauge {

using ClassTable = std::array<std::uint8_t, kByteValues>;  // the class of every byte

// The classes of a colour's three bytes.
struct ColourClasses {
  ClassTable luma;
  ClassTable red;
  ClassTable green;
};

// How often the bytes of colours occur.
class ColourCounts {
 public:
  void add(const CellColour& colour) {
    ++luma_[colour.luma];
    ++red_[colour.red];
    ++green_[colour.green];
    ++total_;
  }

  // Classes of about equal counts.
  ColourClasses equal_classes(int luma_classes, int share_classes) const {
    return {split(luma_, luma_classes), split(red_, share_classes), split(green_, share_classes)};
  }

 private:
  using ByteCounts = std::array<int, kByteValues>;

  ClassTable split(const ByteCounts& counts, int classes) const {
    ClassTable table{};
    int below = 0;
    for (std::size_t value = 0; value < counts.size(); ++value) {
      const int middle = 2 * below + counts[value];
      table[value] =
          static_cast<std::uint8_t>(std::min(classes - 1, classes * middle / std::max(1, 2 * total_)));
      below += counts[value];
    }
    return table;
  }

  ByteCounts luma_{};
  ByteCounts red_{};
  ByteCounts green_{};
  int total_ = 0;
};

}  // namespace traygauge
