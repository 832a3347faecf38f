// The cells beside a cell.
#pragma once

#include <cstddef>

namespace traygauge {

// Calls take(neighbour, side) for the up to four cells that share a side with `cell`, row by row an index
// into a raster of this width and number of cells; `side` counts left, right, above, below from 0.
template <class Take>
void for_each_neighbour(int cell, int width, int cells, Take&& take) {
  const int x = cell % width;
  if (x > 0) take(cell - 1, std::size_t{0});
  if (x + 1 < width) take(cell + 1, std::size_t{1});
  if (cell >= width) take(cell - width, std::size_t{2});
  if (cell + width < cells) take(cell + width, std::size_t{3});
}

}  // namespace traygauge
