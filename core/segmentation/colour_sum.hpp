// Sums of the colours of several cells.
#pragma once

#include <cstdint>

#include "core/segmentation/dish_raster.hpp"

namespace traygauge {

struct ColourSum {
  int luma = 0;
  int red = 0;
  int green = 0;

  void add(const CellColour& colour) {
    luma += colour.luma;
    red += colour.red;
    green += colour.green;
  }
  // Of `count` cells, rounded down.
  CellColour mean(int count) const {
    return {static_cast<std::uint8_t>(luma / count), static_cast<std::uint8_t>(red / count),
            static_cast<std::uint8_t>(green / count)};
  }
};

}  // namespace traygauge
