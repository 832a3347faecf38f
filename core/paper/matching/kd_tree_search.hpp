// Exact nearest neighbours by a k-d tree with backtracking (Friedman, Bentley, Finkel 1977; paper [26]).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/paper/features/keypoint.hpp"
#include "core/paper/matching/neighbours.hpp"
#include "core/paper/matching/packed_descriptors.hpp"

namespace traygauge::paper {

inline constexpr int kMaxTreeDepth = 24;  // halving blocks: enough for 2^24 blocks of eight

// A cut between two halves. A child is a node, or ~block when it is a leaf.
struct KdNode {
  std::array<std::int32_t, 2> child{};
  std::array<float, 2> edge{};  // greatest coordinate of the lower half, smallest of the upper
  std::int32_t dimension = 0;
};

// One tree for each sign group, over the blocks of a PackedDescriptors.
struct KdTree {
  static constexpr std::int32_t kEmpty = INT32_MIN;
  std::span<KdNode> nodes;
  std::array<std::int32_t, kSignGroups> roots{};

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_features) {
    nodes = arena.template take<KdNode>(PackedDescriptors::max_blocks(max_features));
  }
};

// Builds the trees by reordering `packed.slots` within each group, then fills the blocks.
void build_tree(const FeatureSet& features, PackedDescriptors& packed, KdTree& tree);

// The `count` nearest of every query among the tree's features; `neighbours` has the queries' size.
void search_tree(const FeatureSet& queries, const PackedDescriptors& packed, const KdTree& tree, int count,
                 std::span<Neighbours> neighbours);

}  // namespace traygauge::paper
