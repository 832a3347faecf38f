// Symmetric nearest-neighbour matching (paper III-A-1; Table I compares the options).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/features/keypoint.hpp"
#include "core/matching/match.hpp"

namespace traygauge {

struct MatcherParams {
  int top_ranking = 1;  // k: a pair counts when each is among the other's k nearest; 1 or 2 (Table I)
  float distinctiveness_ratio =
      1.1F;                      // second-best / best distance at least this; 1 switches it off (Table I)
  float distance_cutoff = 0.0F;  // share of the worst matches dropped by distance, 0 to 1 (Table I)
  enum class Search : std::uint8_t { exhaustive, kd_tree } search = Search::exhaustive;
};

struct MatcherWorkspace;

}  // namespace traygauge
