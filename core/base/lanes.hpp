// Compiler vectors for sums of floats: the order of the additions is written down, so every processor gets
// the same bits.
#pragma once

#include <cstring>

namespace traygauge {

inline constexpr int kFloatLanes = 4;
using FloatLanes [[gnu::vector_size(16)]] = float;
static_assert(sizeof(FloatLanes) == kFloatLanes * sizeof(float));

inline FloatLanes load_floats(const float* source) {
  FloatLanes lanes;
  std::memcpy(&lanes, source, sizeof lanes);
  return lanes;
}

inline void store_floats(float* target, FloatLanes lanes) {
  std::memcpy(target, &lanes, sizeof lanes);
}

}  // namespace traygauge
