#include "core/paper/matching/kd_tree_search.hpp"

#include <algorithm>

namespace traygauge::paper {

namespace {

// Bounds and distances are rounded differently: a bound prunes only beyond this relative margin, which covers
// the 64 additions of either, so that the tree finds exactly what the exhaustive search finds.
constexpr float kRoundingMargin = 1.0F - 4e-5F;

// The dimension in which these features vary most.
int widest_dimension(std::span<const Descriptor> descriptors, std::span<const std::int32_t> members) {
  std::array<double, kDescriptorLength> sum{};
  std::array<double, kDescriptorLength> square{};
  for (const std::int32_t member : members) {
    const Descriptor& descriptor = descriptors[static_cast<std::size_t>(member)];
    for (std::size_t d = 0; d < kDescriptorLength; ++d) {
      sum[d] += static_cast<double>(descriptor[d]);
      square[d] += static_cast<double>(descriptor[d]) * static_cast<double>(descriptor[d]);
    }
  }
  const auto count = static_cast<double>(members.size());
  int widest = 0;
  double best = -1.0;
  for (int d = 0; d < kDescriptorLength; ++d) {
    const auto i = static_cast<std::size_t>(d);
    const double variance = square[i] - sum[i] * sum[i] / count;
    if (variance > best) {
      best = variance;
      widest = d;
    }
  }
  return widest;
}

// Cuts the members so that `lower` of them come first; equal coordinates go by index.
KdNode cut(std::span<const Descriptor> descriptors, std::span<std::int32_t> members, std::size_t lower) {
  KdNode node;
  node.dimension = widest_dimension(descriptors, members);
  const auto d = static_cast<std::size_t>(node.dimension);
  const auto coordinate = [&](std::int32_t i) { return descriptors[static_cast<std::size_t>(i)][d]; };
  const auto before = [&](std::int32_t a, std::int32_t b) {
    return coordinate(a) != coordinate(b) ? coordinate(a) < coordinate(b) : a < b;
  };
  const auto middle = members.begin() + static_cast<std::ptrdiff_t>(lower);
  std::nth_element(members.begin(), middle, members.end(), before);
  node.edge = {coordinate(*std::max_element(members.begin(), middle, before)), coordinate(*middle)};
  return node;
}

struct Branch {
  BlockRange blocks;
  std::int32_t* link;  // where the parent refers to this branch
};

// Returns the root; takes nodes from `nodes` on at `used`.
std::int32_t build_group(std::span<const Descriptor> descriptors, PackedDescriptors& packed, BlockRange group,
                         std::span<KdNode> nodes, std::size_t& used) {
  std::int32_t root = KdTree::kEmpty;
  if (group.begin == group.end) return root;
  auto last_slot = static_cast<std::size_t>(group.end) * kBlockSize;
  while (packed.slots[last_slot - 1] < 0) --last_slot;
  std::array<Branch, kMaxTreeDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = {group, &root};
  while (depth > 0) {
    const Branch branch = stack[--depth];
    if (branch.blocks.end - branch.blocks.begin == 1) {
      *branch.link = ~branch.blocks.begin;
      continue;
    }
    const int middle = (branch.blocks.begin + branch.blocks.end) / 2;
    const auto begin = static_cast<std::size_t>(branch.blocks.begin) * kBlockSize;
    const auto end = std::min(static_cast<std::size_t>(branch.blocks.end) * kBlockSize, last_slot);
    const auto lower = static_cast<std::size_t>(middle) * kBlockSize - begin;
    *branch.link = static_cast<std::int32_t>(used);
    KdNode& node = nodes[used++];
    node = cut(descriptors, packed.slots.subspan(begin, end - begin), lower);
    stack[depth++] = {{middle, branch.blocks.end}, node.child.data() + 1};
    stack[depth++] = {{branch.blocks.begin, middle}, node.child.data()};
  }
  return root;
}

// A subtree still to be visited: how far it lies at least, in all and in the dimension of the cut above it.
struct Visit {
  std::int32_t child;
  int depth;
  int dimension;
  float gap;
  float bound;
};

using Gaps = std::array<float, kDescriptorLength>;  // distance of the query from a cell in each dimension

void scan_leaf(const Descriptor& query, const PackedDescriptors& packed, int block, int count,
               Neighbours& neighbours) {
  std::array<float, kBlockSize> squares;
  block_squares(query, packed.block(block), squares);
  for (std::size_t j = 0; j < kBlockSize; ++j) {
    const std::int32_t feature = packed.slots[static_cast<std::size_t>(block) * kBlockSize + j];
    if (feature >= 0 && squares[j] <= neighbours.limit(count)) neighbours.insert(squares[j], feature, count);
  }
}

// Depth first, nearer half first. gaps[depth] belongs to the cell being visited at that depth: it stays valid
// until the farther half, visited after everything below the nearer one, copies it.
void search_group(const Descriptor& query, const PackedDescriptors& packed, const KdTree& tree,
                  std::int32_t root, int count, Neighbours& neighbours) {
  std::array<Visit, kMaxTreeDepth> stack;
  std::array<Gaps, kMaxTreeDepth> gaps;
  gaps[0].fill(0.0F);
  std::size_t size = 0;
  stack[size++] = {root, 0, 0, 0.0F, 0.0F};
  while (size > 0) {
    const Visit visit = stack[--size];
    if (visit.bound * kRoundingMargin > neighbours.limit(count)) continue;
    if (visit.child < 0) {
      scan_leaf(query, packed, ~visit.child, count, neighbours);
      continue;
    }
    const auto depth = static_cast<std::size_t>(visit.depth);
    if (depth > 0) gaps[depth] = gaps[depth - 1];
    gaps[depth][static_cast<std::size_t>(visit.dimension)] = visit.gap;
    const KdNode& node = tree.nodes[static_cast<std::size_t>(visit.child)];
    const float coordinate = query[static_cast<std::size_t>(node.dimension)];
    const float gap = gaps[depth][static_cast<std::size_t>(node.dimension)];
    std::array<Visit, 2> halves;
    for (std::size_t side = 0; side < 2; ++side) {
      const float beyond = side == 0 ? coordinate - node.edge[0] : node.edge[1] - coordinate;
      const float wider = std::max(gap, beyond);
      halves[side] = {node.child[side], visit.depth + 1, node.dimension, wider,
                      visit.bound + (wider * wider - gap * gap)};
    }
    const std::size_t nearer = halves[0].bound <= halves[1].bound ? 0 : 1;
    stack[size++] = halves[1 - nearer];
    stack[size++] = halves[nearer];
  }
}

}  // namespace

void build_tree(const FeatureSet& features, PackedDescriptors& packed, KdTree& tree) {
  assign_slots(features.keypoints, packed);
  std::size_t used = 0;
  for (int sign = 0; sign < kSignGroups; ++sign) {
    tree.roots[static_cast<std::size_t>(sign)] =
        build_group(features.descriptors, packed, packed.group(sign), tree.nodes, used);
  }
  fill_blocks(features.descriptors, packed);
}

void search_tree(const FeatureSet& queries, const PackedDescriptors& packed, const KdTree& tree, int count,
                 std::span<Neighbours> neighbours) {
  for (std::size_t i = 0; i < queries.descriptors.size(); ++i) {
    neighbours[i].clear();
    const int sign = sign_group(queries.keypoints[i].laplacian);
    for (int group = 0; group < kSignGroups; ++group) {
      const std::int32_t root = tree.roots[static_cast<std::size_t>(group)];
      const bool comparable = sign == group || sign == 1 || group == 1;
      if (root == KdTree::kEmpty || !comparable) continue;
      search_group(queries.descriptors[i], packed, tree, root, count, neighbours[i]);
    }
  }
}

}  // namespace traygauge::paper
