// Parabolas through three values at -1, 0 and 1.
#pragma once

#include <array>

#include "core/geometry/geometry.hpp"

namespace traygauge {

// Where it is highest; 0 where it has no top.
template <class Value>
constexpr double parabola_top(Value before, Value middle, Value after) {
  const Value bend = before - Value{2} * middle + after;
  return bend < Value{0} ? 0.5 * static_cast<double>((before - after) / bend) : 0.0;
}

// Where a straight line of some centimetres is seen: perspective and lens bend it little more.
class PixelParabola {
 public:
  explicit PixelParabola(const std::array<Vec2, 3>& pixels)
      : middle_(pixels[1]),
        slope_(0.5 * (pixels[2] - pixels[0])),
        bend_(0.5 * (pixels[2] + pixels[0]) - pixels[1]) {}

  Vec2 at(double t) const { return middle_ + t * slope_ + t * t * bend_; }

 private:
  Vec2 middle_;
  Vec2 slope_;
  Vec2 bend_;
};

}  // namespace traygauge
