#include "core/stereo/subpixel.hpp"

namespace traygauge {

int parabola_offset(int before, int middle, int after) {
  const int curvature = before - 2 * middle + after;
  if (before < middle || after < middle || curvature <= 0) return 0;
  const int numerator = kDisparityScale * (before - after);
  const int denominator = 2 * curvature;
  return (numerator >= 0 ? numerator + curvature : numerator - curvature) / denominator;
}

}  // namespace traygauge
