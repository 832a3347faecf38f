// The path costs of a pixel's band of disparities in SIMD registers, and their sums over the paths.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/stereo/row_lanes.hpp"
#include "core/stereo/sgm.hpp"

namespace traygauge {

// Path costs stay below worst cost + large penalty; a pad above that never wins and never overflows.
inline constexpr std::uint8_t kPadCost = 200;
inline constexpr int kWorstCost = 63;

inline ByteLanes least(ByteLanes a, ByteLanes b) {
  return a < b ? a : b;
}

using WideLanes [[gnu::vector_size(16)]] = std::uint16_t;
using WordLanes [[gnu::vector_size(16)]] = std::uint32_t;
using DoubleWordLanes [[gnu::vector_size(16)]] = std::uint64_t;

// One byte in all lanes; the multiplication spares the compiler's byte by byte assembly.
inline ByteLanes spread(std::uint8_t value) {
  const std::uint64_t eight = value * std::uint64_t{0x0101010101010101};
  return reinterpret_cast<ByteLanes>(DoubleWordLanes{eight, eight});
}

// The least lane, in all lanes. Shuffles of whole words are single instructions on every processor.
inline ByteLanes spread_least(ByteLanes v) {
  const auto words = reinterpret_cast<WordLanes>(v);
  v = least(v, reinterpret_cast<ByteLanes>(__builtin_shufflevector(words, words, 2, 3, 0, 1)));
  const auto pairs = reinterpret_cast<WordLanes>(v);
  v = least(v, reinterpret_cast<ByteLanes>(__builtin_shufflevector(pairs, pairs, 1, 0, 3, 2)));
  const auto halves = reinterpret_cast<WordLanes>(v);
  v = least(v, reinterpret_cast<ByteLanes>((halves << 16) | (halves >> 16)));
  const auto bytes = reinterpret_cast<WideLanes>(v);
  return least(v, reinterpret_cast<ByteLanes>((bytes << 8) | (bytes >> 8)));
}

// Sums are kept as bytes come apart: the even lanes of a register, then the odd ones.
inline constexpr int kHalfLanes = kBandLanes / 2;
static_assert(std::endian::native == std::endian::little, "even lanes are the low bytes of pairs");

// The path costs of a band of kChunks registers, between paddings that never win: neighbours' bands are read
// at their offset.
template <int kChunks>
struct PathCosts {
  std::uint8_t low_padding[kBandPadding];
  std::uint8_t lanes[static_cast<std::size_t>(kChunks * kBandLanes)];
  std::uint8_t high_padding[kBandPadding];
  ByteLanes least;  // of the lanes, in each

  void clear() {
    std::memset(low_padding, kPadCost, kBandPadding);
    std::memset(lanes, 0, sizeof lanes);
    std::memset(high_padding, kPadCost, kBandPadding);
    least = ByteLanes{};
  }
};

constexpr int sum_index(int lane) {
  return lane / kBandLanes * kBandLanes + lane % 2 * kHalfLanes + lane % kBandLanes / 2;
}

// The disparity of the least sum, the lower one of equal sums.
template <int kLanes>
int find_least(const std::uint16_t* sums) {
  constexpr WideLanes kSteps{0, 2, 4, 6, 8, 10, 12, 14};
  int least_key = std::numeric_limits<int>::max();
  int best = 0;
  for (int chunk = 0; chunk < kLanes; chunk += kBandLanes) {
    // Sums of eight paths below 2^10 leave room for the lane; signed, so that every processor compares them.
    const auto even = reinterpret_cast<CostLanes>((load_lanes<WideLanes>(sums + chunk) << 4) | kSteps);
    const auto odd =
        reinterpret_cast<CostLanes>((load_lanes<WideLanes>(sums + chunk + kHalfLanes) << 4) | (kSteps + 1));
    const CostLanes keys = smaller(even, odd);
    int key = keys[0];
    for (int i = 1; i < kHalfLanes; ++i) key = std::min<int>(key, keys[i]);
    if ((key >> 4) < (least_key >> 4)) {
      least_key = key;
      best = chunk + (key & 15);
    }
  }
  return best;
}

// Adds the costs of two paths to the sums of a band, or makes them the first of them.
template <int kChunks>
void add_paths(const PathCosts<kChunks>& a, const PathCosts<kChunks>& b, bool first, std::uint16_t* sums) {
  for (int chunk = 0; chunk < kChunks; ++chunk) {
    const std::ptrdiff_t first_lane = std::ptrdiff_t{chunk} * kBandLanes;
    // Two path costs fit a byte: twice worst cost and large penalty.
    const auto pair = reinterpret_cast<WideLanes>(load_lanes<ByteLanes>(a.lanes + first_lane) +
                                                  load_lanes<ByteLanes>(b.lanes + first_lane));
    WideLanes even = pair & 0xff;
    WideLanes odd = pair >> 8;
    std::uint16_t* at = sums + first_lane;
    if (!first) {
      even += load_lanes<WideLanes>(at);
      odd += load_lanes<WideLanes>(at + kHalfLanes);
    }
    std::memcpy(at, &even, sizeof even);
    std::memcpy(at + kHalfLanes, &odd, sizeof odd);
  }
}

}  // namespace traygauge
