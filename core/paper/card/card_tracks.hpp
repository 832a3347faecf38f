// Tracks of the card's points: first view, second view and pattern (paper III-A-3).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/card/card.hpp"
#include "core/geometry/geometry.hpp"
#include "core/paper/matching/match.hpp"

namespace traygauge::paper {

// All matches sorted by their first, then second index, as match_features leaves them.
struct CardObservations {
  std::span<const Match> first_second;
  std::span<const std::uint8_t> in_cloud;  // a flag for each of first_second: inlier of the relative pose
  std::span<const Vec3> cloud;             // its point in the first camera, in baselines; read where flagged
  std::span<const Match> first_pattern;
  std::span<const Match> second_pattern;
  std::span<const Vec2> first_rays;  // of each feature
  std::span<const Vec2> second_rays;
  std::span<const Vec2> pattern_mm;
};

// One track for each match of the views, of the sparse cloud, whose ends agree on a point of the pattern.
void build_card_tracks(const CardObservations& observations, BoundedList<CardTrack>& tracks);

}  // namespace traygauge::paper
