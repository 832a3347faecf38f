// Eight rows side by side: the rows of the dynamic programming are independent, so each SIMD lane walks one.
// Compiler vectors keep the arithmetic integer and equal on every processor.
#pragma once

#include <cstdint>
#include <cstring>

namespace traygauge {

inline constexpr int kRowLanes = 8;
inline constexpr int kMaxWindowRadius = 4;
inline constexpr int kMaxCensusRadius = 4;
inline constexpr int kCostRows = kRowLanes + 2 * kMaxWindowRadius;   // rows that a block's windows cover
inline constexpr int kPixelRows = kCostRows + 2 * kMaxCensusRadius;  // rows that their census covers
inline constexpr int kFirstPixelRow = -kMaxWindowRadius - kMaxCensusRadius;  // relative to the block's first

using ByteLanes [[gnu::vector_size(16)]] = std::uint8_t;     // kCostRows rows
using SignLanes [[gnu::vector_size(16)]] = std::int8_t;      // kCostRows rows, comparable on every processor
using CostLanes [[gnu::vector_size(16)]] = std::int16_t;     // kRowLanes rows
using HalfByteLanes [[gnu::vector_size(8)]] = std::uint8_t;  // kRowLanes rows
static_assert(sizeof(ByteLanes) == kCostRows && sizeof(CostLanes) == sizeof(std::int16_t) * kRowLanes);

// A column of a picture over the rows of a block.
struct alignas(32) PixelColumn {
  std::uint8_t row[32];  // kPixelRows used
};

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

// Inclusive; empty when hi < lo.
struct Interval {
  int lo = 0;
  int hi = -1;
  constexpr int count() const { return hi - lo + 1; }
  constexpr bool empty() const { return hi < lo; }
  constexpr bool contains(int d) const { return d >= lo && d <= hi; }
};

constexpr Interval hull(Interval a, Interval b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {a.lo < b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi};
}

}  // namespace traygauge
