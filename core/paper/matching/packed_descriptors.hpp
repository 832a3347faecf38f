// Descriptors regrouped for distance computations: blocks of eight, dimension by dimension, one group for
// each sign of the Laplacian.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/paper/features/keypoint.hpp"

namespace traygauge::paper {

inline constexpr int kBlockSize = 8;  // descriptors side by side: two or one SIMD registers
inline constexpr int kBlockFloats = kBlockSize * kDescriptorLength;
inline constexpr int kSignGroups = 3;  // dark, unknown, bright

// The group of a Laplacian sign: 0, 1 or 2.
constexpr int sign_group(int laplacian) {
  return laplacian < 0 ? 0 : laplacian > 0 ? 2 : 1;
}

// A run of blocks.
struct BlockRange {
  int begin = 0;
  int end = 0;
};

struct PackedDescriptors {
  std::span<float> values;                         // block, dimension, place in the block
  std::span<std::int32_t> slots;                   // feature in each place; −1 pads a group's last block
  std::array<int, kSignGroups + 1> group_begin{};  // first block of each group

  static constexpr std::size_t max_blocks(int max_features) {
    return static_cast<std::size_t>(max_features) / kBlockSize + kSignGroups;
  }
  static constexpr std::size_t max_slots(int max_features) { return max_blocks(max_features) * kBlockSize; }

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_features) {
    values = arena.template take<float>(max_slots(max_features) * kDescriptorLength);
    slots = arena.template take<std::int32_t>(max_slots(max_features));
  }

  BlockRange group(int sign) const {
    const auto g = static_cast<std::size_t>(sign);
    return {group_begin[g], group_begin[g + 1]};
  }
  // The blocks that features of this group are compared with: their own and those of unknown sign.
  BlockRange comparable(int sign) const {
    return {sign == 2 ? group_begin[1] : group_begin[0], sign == 0 ? group_begin[2] : group_begin[3]};
  }
  const float* block(int b) const { return values.data() + std::ptrdiff_t{b} * kBlockFloats; }
};

// Assigns the first `count` keypoints to slots, group by group, by index within a group.
void assign_slots(std::span<const Keypoint> keypoints, PackedDescriptors& packed);

// Copies the descriptors to the places that `slots` states.
void fill_blocks(std::span<const Descriptor> descriptors, PackedDescriptors& packed);

// Squared distances from `query` to the eight descriptors of a block. Every distance is summed dimension by
// dimension: all searches and all processors see the same bits.
inline void block_squares(const Descriptor& query, const float* block,
                          std::array<float, kBlockSize>& squares) {
  std::array<float, kBlockSize> sums{};
  for (std::size_t d = 0; d < kDescriptorLength; ++d) {
    const float* column = block + d * kBlockSize;
    for (std::size_t j = 0; j < kBlockSize; ++j) {
      const float difference = query[d] - column[j];
      sums[j] += difference * difference;
    }
  }
  squares = sums;
}

}  // namespace traygauge::paper
