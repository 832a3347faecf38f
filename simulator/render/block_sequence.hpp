// One sequence for a block of pixels, for what is smoothed over them.
#pragma once

#include <cstdint>

#include "simulator/render/sample_sequence.hpp"

namespace traygauge {

// Of the sequence's points, each 64 in a row are those of a block's 8 × 8 pixels, one each, and each 4 in a
// row those of four neighbours: together they fill the square as evenly as a single pixel's.
class BlockSequence {
 public:
  BlockSequence() : BlockSequence(0, 0, 0) {}
  BlockSequence(std::uint32_t seed, int x, int y)
      : sequence_(hash_of(hash_of(seed, static_cast<std::uint32_t>(y) / kSide),
                          static_cast<std::uint32_t>(x) / kSide)),
        place_(spread(static_cast<std::uint32_t>(x) % kSide) |
               (spread(static_cast<std::uint32_t>(y) % kSide) << 1U)) {}

  const SampleSequence& sequence() const { return sequence_; }
  // Of the pixel's point with this number.
  std::uint32_t index(std::uint32_t number) const { return number * kSide * kSide + place_; }

 private:
  static constexpr std::uint32_t kSide = 8;

  // Puts a zero before each of three bits.
  static constexpr std::uint32_t spread(std::uint32_t x) {
    return (x & 1U) | ((x & 2U) << 1U) | ((x & 4U) << 2U);
  }

  SampleSequence sequence_;
  std::uint32_t place_;
};

}  // namespace traygauge
