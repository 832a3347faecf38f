// Units in those of the geometry (mm, radians), and what the values of a byte are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace traygauge {

inline constexpr double kMm3PerMl = 1000.0;                            // SI
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;  // definition
inline constexpr std::size_t kByteValues = 256;                        // grey values, labels
// Grey value from which all channels are at their end.
inline constexpr std::uint8_t kBurntGray = 252;

}  // namespace traygauge
