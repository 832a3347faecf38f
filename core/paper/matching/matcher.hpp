// Symmetric nearest-neighbour matching (paper III-A-1; Table I compares the options).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/paper/features/keypoint.hpp"
#include "core/paper/matching/match.hpp"
#include "core/paper/matching/nearest_neighbours.hpp"

namespace traygauge::paper {

struct MatcherParams {
  // k: a pair counts when each is among the other's k nearest; 1 or 2 (Table I).
  int top_ranking = 1;
  // The next neighbour lies at least this many times farther, seen from either side; 1 switches the test off
  // (Table I: 1.1 is best, more loses valid matches).
  float distinctiveness_ratio = 1.1F;
  // Share of the worst matches dropped by distance, 0 to 1 (Table I: dropping any makes volumes worse).
  float distance_cutoff = 0.0F;
};

// Scratch for two pictures of up to `max_features` features each; features beyond the cap are ignored.
struct MatcherWorkspace {
  NeighbourWorkspace search;
  std::span<Neighbours> of_first;
  std::span<Neighbours> of_second;
  std::span<Match> candidates;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_features) {
    const auto count = static_cast<std::size_t>(max_features);
    search.allocate(arena, max_features);
    of_first = arena.template take<Neighbours>(count);
    of_second = arena.template take<Neighbours>(count);
    candidates = arena.template take<Match>(2 * count);  // up to two pairs a feature
  }
};

// Pairs that are mutual k-nearest neighbours and distinct enough, in the order of their first, then second
// index. Bright blobs are never compared with dark ones. When `matches` is too short the nearest pairs stay.
void match_features(const FeatureSet& first, const FeatureSet& second, const MatcherParams& params,
                    MatcherWorkspace& workspace, BoundedList<Match>& matches);

}  // namespace traygauge::paper
