// Colours as people write them.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace traygauge {

// Linear RGB of 0xRRGGBB in sRGB.
Eigen::Vector3f linear_colour(std::uint32_t srgb);

inline Eigen::Vector3f blend(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float share) {
  return from + share * (to - from);
}

// 0 below `low`, 1 above `high`, smooth between.
float smooth_step(float low, float high, float value);

}  // namespace traygauge
