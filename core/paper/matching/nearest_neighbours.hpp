// Nearest neighbours of descriptors by comparing everything with everything, both directions in one pass. In
// 64 dimensions a k-d tree (paper III-A-1) visits most of its leaves; this finds the same neighbours faster.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/paper/features/keypoint.hpp"

namespace traygauge::paper {

inline constexpr int kMaxNeighbours = 3;  // two that can match, and the one that the second is judged against

// The few nearest neighbours of one feature, nearest first.
struct Neighbours {
  std::array<float, kMaxNeighbours> square{};  // squared distances; infinite where there is no neighbour
  std::array<std::int32_t, kMaxNeighbours> index{};

  void clear() {
    square.fill(std::numeric_limits<float>::infinity());
    index.fill(-1);
  }

  // The squared distance beyond which nothing enters the first `count` places.
  float limit(int count) const { return square[static_cast<std::size_t>(count - 1)]; }

  // Keeps the `count` nearest. Equal distances go by index, so the order of the search does not matter.
  void insert(float candidate_square, std::int32_t candidate, int count) {
    auto place = static_cast<std::size_t>(count);
    while (place > 0 && is_nearer(candidate_square, candidate, place - 1)) --place;
    if (place == static_cast<std::size_t>(count)) return;
    for (auto i = static_cast<std::size_t>(count - 1); i > place; --i) {
      square[i] = square[i - 1];
      index[i] = index[i - 1];
    }
    square[place] = candidate_square;
    index[place] = candidate;
  }

 private:
  bool is_nearer(float candidate_square, std::int32_t candidate, std::size_t place) const {
    if (candidate_square != square[place]) return candidate_square < square[place];
    return index[place] < 0 || candidate < index[place];
  }
};

// Scratch for two pictures of up to `max_features` features each.
struct NeighbourWorkspace {
  static constexpr int kBlockSize = 8;   // descriptors side by side: two or one SIMD registers
  static constexpr int kSignGroups = 3;  // of the Laplacian: dark, unknown, bright

  // The second picture's descriptors: block, dimension, place in the block. A group has blocks of its own.
  std::span<float> values;
  std::span<std::int32_t> slots;                   // feature in each place; −1 pads a group's last block
  std::array<int, kSignGroups + 1> group_begin{};  // first block of each group
  std::span<float> column_limits;                  // by slot
  std::span<std::int32_t> rows;                    // the first picture's features of one sign

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_features) {
    const auto count = static_cast<std::size_t>(max_features);
    const std::size_t max_slots = (count / kBlockSize + kSignGroups) * kBlockSize;
    values = arena.template take<float>(max_slots * kDescriptorLength);
    slots = arena.template take<std::int32_t>(max_slots);
    column_limits = arena.template take<float>(max_slots);
    rows = arena.template take<std::int32_t>(count);
  }
};

// Finds the `count` nearest of every feature of either picture; the lists have the pictures' sizes.
void find_nearest_neighbours(const FeatureSet& first, const FeatureSet& second, int count,
                             NeighbourWorkspace& workspace, std::span<Neighbours> of_first,
                             std::span<Neighbours> of_second);

}  // namespace traygauge::paper
