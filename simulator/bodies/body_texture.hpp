// What is printed on proof bodies: squares of random greys, so that there are corners wherever two meet.
#pragma once

#include <cstdint>
#include <string_view>

namespace traygauge {

inline constexpr double kBodyCellMm = 2.0;

// The sRGB grey of a square of a body's sheet, from 0 to 255; the same on every machine, for ever, since
// bodies outlive programs. Columns and rows count from the piece's origin and may be negative.
std::uint8_t body_cell_gray(std::string_view body_id, int piece, int column, int row);

}  // namespace traygauge
