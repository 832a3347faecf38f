// The rows of a picture that a block of kRowLanes rows is matched from, and ranges of disparities.
#pragma once

#include <cstdint>

#include "core/stereo/row_lanes.hpp"

namespace traygauge::paper {

inline constexpr int kMaxWindowRadius = 4;
inline constexpr int kMaxCensusRadius = 4;
inline constexpr int kCostRows = kRowLanes + 2 * kMaxWindowRadius;   // rows that a block's windows cover
inline constexpr int kPixelRows = kCostRows + 2 * kMaxCensusRadius;  // rows that their census covers
inline constexpr int kFirstPixelRow = -kMaxWindowRadius - kMaxCensusRadius;  // relative to the block's first

using HalfByteLanes [[gnu::vector_size(8)]] = std::uint8_t;  // kRowLanes rows
static_assert(sizeof(ByteLanes) == kCostRows);

// A column of a picture over the rows of a block.
struct alignas(32) PixelColumn {
  std::uint8_t row[32];  // kPixelRows used
};

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

}  // namespace traygauge::paper
