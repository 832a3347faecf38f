// A scan's shape as a station composes it; see compose_shape().
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"

namespace traygauge {

// Cells row by row, in mm; x to the right, y away.
struct DishShape {
  int dish = 0;
  double cell_mm = 0.0;
  int columns = 0;
  int rows = 0;
  double origin_x_mm = 0.0;  // of the middle of the first cell
  double origin_y_mm = 0.0;
  std::vector<std::optional<int>> surface_tenth_mm;  // none: nothing is known
  std::vector<std::optional<int>> inner_tenth_mm;    // none: outside of the dish
  std::vector<int> labels;                           // 0: no food

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  }
};

struct ReadShape {
  std::string id;
  std::vector<DishShape> dishes;
};

// Fails, with what was expected, where a part is absent, of another type or length, or out of range.
Expected<ReadShape> read_shape(const std::string& text);

}  // namespace traygauge
