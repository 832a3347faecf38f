#include "simulator/scenes/colour.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {

Eigen::Vector3f linear_colour(std::uint32_t srgb) {
  const auto channel = [&](unsigned shift) {  // IEC 61966-2-1
    const float value = static_cast<float>((srgb >> shift) & 255U) / 255.0F;
    return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
  };
  return {channel(16U), channel(8U), channel(0U)};
}

float smooth_step(float low, float high, float value) {
  const float t = std::clamp((value - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

}  // namespace traygauge
