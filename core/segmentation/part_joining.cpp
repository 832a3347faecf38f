#include "core/segmentation/part_joining.hpp"

#include <algorithm>
#include <limits>

namespace traygauge {
namespace {

double likeness_of(const PartSigns& signs, const PartLikenessParams& params) {
  return params.constant + params.embedding * signs.embedding +
         params.share * std::min(signs.share, params.most_share);
}

}  // namespace

std::span<const PartBorder> measure_borders(const FoodParts& parts, PartJoiningWorkspace& workspace) {
  for (FoodBlock& block : parts.blocks()) block.sides = 0;
  std::size_t count = 0;
  parts.for_each_side([&](int block, int neighbour) {
    const int own = parts.is_food(block) ? parts.root(block) : -1;
    const int other = parts.is_food(neighbour) ? parts.root(neighbour) : -1;
    if (own == other) return;
    if (own >= 0) ++parts.at(own).sides;
    if (other >= 0) ++parts.at(other).sides;
    if (own < 0 || other < 0) return;
    const int first = std::min(own, other);
    const int second = std::max(own, other);
    const auto known = workspace.borders.first(count);
    auto border = std::find_if(known.begin(), known.end(),
                               [&](const PartBorder& b) { return b.first == first && b.second == second; });
    if (border == known.end()) {
      if (count == workspace.borders.size()) return;
      workspace.borders[count++] = {first, second, 0};
      border = workspace.borders.begin() + static_cast<std::ptrdiff_t>(count - 1);
    }
    ++border->sides;
  });
  return workspace.borders.first(count);
}

PartSigns signs_of(const FoodParts& parts, const PartBorder& border) {
  const FoodBlock& a = parts.at(border.first);
  const FoodBlock& b = parts.at(border.second);
  const FoodBlock& smaller = a.size < b.size ? a : b;
  return {static_cast<double>(FoodParts::embedding_between(a, b)),
          static_cast<double>(border.sides) / std::max(1, smaller.sides)};
}

double join_like_parts(const PartLikenessParams& params, int least_blocks, PartJoiningWorkspace& workspace,
                       const FoodParts& parts) {
  // Each round joins two, so there are at most as many as parts.
  for (;;) {
    double most = 0.0;
    double most_apart = -std::numeric_limits<double>::infinity();
    const PartBorder* best = nullptr;
    for (const PartBorder& border : measure_borders(parts, workspace)) {
      const double likeness = likeness_of(signs_of(parts, border), params);
      if (std::min(parts.at(border.first).size, parts.at(border.second).size) >= least_blocks)
        most_apart = std::max(most_apart, likeness);
      if (likeness <= most) continue;
      most = likeness;
      best = &border;
    }
    if (best == nullptr) return most_apart;
    parts.join(best->first, best->second);
  }
}

}  // namespace traygauge
