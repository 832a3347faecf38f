// Eight rows side by side: the rows of the dynamic programming are independent, so each SIMD lane walks one.
// Compiler vectors keep the arithmetic integer and equal on every processor.
#pragma once

#include <cstdint>
#include <cstring>

namespace traygauge {

using ByteLanes [[gnu::vector_size(16)]] = std::uint8_t;
using SignLanes [[gnu::vector_size(16)]] = std::int8_t;  // comparable on every processor
using CostLanes [[gnu::vector_size(16)]] = std::int16_t;
inline constexpr int kRowLanes = sizeof(CostLanes) / sizeof(std::int16_t);

inline CostLanes broadcast(int value) {
  return CostLanes{} + static_cast<std::int16_t>(value);
}

inline ByteLanes broadcast_byte(std::uint8_t value) {
  return ByteLanes{} + value;
}

inline CostLanes smaller(CostLanes a, CostLanes b) {
  return a < b ? a : b;
}

inline CostLanes larger(CostLanes a, CostLanes b) {
  return a > b ? a : b;
}

template <class Lanes, class T>
inline Lanes load_lanes(const T* source) {
  Lanes lanes;
  std::memcpy(&lanes, source, sizeof lanes);
  return lanes;
}

}  // namespace traygauge
