// Compiler vectors for sums of floats: the order of the additions is written down, so every processor gets
// the same bits.
#pragma once

#include <cstring>

namespace traygauge {

using FloatLanes [[gnu::vector_size(16)]] = float;  // a register of SSE and of NEON
inline constexpr int kFloatLanes = sizeof(FloatLanes) / sizeof(float);

// Pixels of a row that a loop takes at a time: whole registers, and a few KB of buffers stay in the cache.
inline constexpr int kRowBlock = 256;

inline FloatLanes load_floats(const float* source) {
  FloatLanes lanes;
  std::memcpy(&lanes, source, sizeof lanes);
  return lanes;
}

inline void store_floats(float* target, FloatLanes lanes) {
  std::memcpy(target, &lanes, sizeof lanes);
}

}  // namespace traygauge
