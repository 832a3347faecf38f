// Fills convex outlines in a label picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

// Calls take(y, left, right) for every row of the picture that the closed convex outline covers: pixels left
// ≤ x < right have their centres inside. O(rows × corners).
template <class Take>
void for_each_covered_row(int width, int height, std::span<const Vec2> outline_px, Take&& take) {
  double top = std::numeric_limits<double>::infinity();
  double bottom = -top;
  for (const Vec2& corner : outline_px) {
    top = std::min(top, corner.y());
    bottom = std::max(bottom, corner.y());
  }
  if (!std::isfinite(top) || !std::isfinite(bottom)) return;
  const int first = static_cast<int>(std::ceil(std::clamp(top, 0.0, static_cast<double>(height))));
  const int last = static_cast<int>(std::floor(std::clamp(bottom, -1.0, height - 1.0)));
  for (int y = first; y <= last; ++y) {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (std::size_t i = 0; i < outline_px.size(); ++i) {
      const Vec2& a = outline_px[i];
      const Vec2& b = outline_px[(i + 1) % outline_px.size()];
      if ((a.y() < y && b.y() < y) || (a.y() > y && b.y() > y) || a.y() == b.y()) continue;
      const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (!(left <= right)) continue;
    const int begin = static_cast<int>(std::ceil(std::clamp(left, 0.0, static_cast<double>(width))));
    const int end = static_cast<int>(std::floor(std::clamp(right, -1.0, width - 1.0))) + 1;
    if (begin < end) take(y, begin, end);
  }
}

inline void fill_convex(ImageView<std::uint8_t> labels, std::span<const Vec2> outline_px,
                        std::uint8_t label) {
  for_each_covered_row(labels.width, labels.height, outline_px, [&](int y, int left, int right) {
    std::fill(labels.row(y) + left, labels.row(y) + right, label);
  });
}

}  // namespace traygauge
