// The reference card's size, and where a picture of its print lies on it.
#pragma once

#include <algorithm>

#include "core/geometry/geometry.hpp"

namespace traygauge {

struct CardModelSize {
  double width_mm = 85.60;    // ISO/IEC 7810 ID-1
  double height_mm = 53.98;   // the same
  double thickness_mm = 0.8;  // the print lies that much above the table; ISO/IEC 7810: 0.76 ± 0.08

  double length_mm() const { return std::max(width_mm, height_mm); }
  double area_mm2() const { return width_mm * height_mm; }
};

// Least cosine between the card's normal and the view: seen at more than 80 degrees, its print is unreadable.
inline constexpr double kMinCardCosine = 0.17;

// Where a pixel of the pattern's picture (`pattern_width_px` wide, centres at integers) lies on the card.
inline Vec2 pattern_mm(const Vec2& pixel, int pattern_width_px, const CardModelSize& size) {
  return (pixel.array() + 0.5).matrix() * (size.width_mm / pattern_width_px);
}

}  // namespace traygauge
