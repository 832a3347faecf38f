// The cells beside a cell.
#pragma once

namespace traygauge {

// Calls take(neighbour) for the up to four cells that share a side with `cell`, row by row an index into a
// raster of this width and number of cells.
template <class Take>
void for_each_neighbour(int cell, int width, int cells, Take&& take) {
  const int x = cell % width;
  if (x > 0) take(cell - 1);
  if (x + 1 < width) take(cell + 1);
  if (cell >= width) take(cell - width);
  if (cell + width < cells) take(cell + width);
}

}  // namespace traygauge
