// The angle of a vector without libm, whose last bits differ between machines.
#pragma once

#include <cmath>

namespace traygauge::paper {

inline constexpr float kPi = 3.14159265F;

// In (−pi, pi], within 2e-5; 0 for the zero vector. Polynomial: Abramowitz & Stegun 4.4.49.
inline float angle_of(float x, float y) {
  const float across = std::abs(x);
  const float along = std::abs(y);
  const float larger = across > along ? across : along;
  const float smaller = across > along ? along : across;
  const float ratio = larger > 0.0F ? smaller / larger : 0.0F;
  const float square = ratio * ratio;
  float angle =
      ratio * (0.9998660F +
               square * (-0.3302995F + square * (0.1801410F + square * (-0.0851330F + square * 0.0208351F))));
  angle = along > across ? 0.5F * kPi - angle : angle;
  angle = x < 0.0F ? kPi - angle : angle;
  return y < 0.0F ? -angle : angle;
}

}  // namespace traygauge::paper
