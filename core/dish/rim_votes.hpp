// The places at which the edges of both views want a dish to stand.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/dish/dish_search.hpp"

namespace traygauge {

inline constexpr std::size_t kMaxRimPeaks = 6;  // places that are looked at in the full pictures

// A place that the edges vote for.
struct RimPeak {
  const DishModel* dish = nullptr;
  DishPose place;
  int inside_sign = 1;  // 1: brighter inside the rim
  double votes_per_mm = -1.0;
};

inline Vec2 direction_of(double azimuth_rad) {
  return {std::cos(azimuth_rad), std::sin(azimuth_rad)};
}

// Fills `peaks` with the best of all candidates, most votes along the rim first, and returns how many there
// are. O(edges + cells) for each candidate, for an oval one as often as there are azimuths.
std::size_t vote_for_places(const DishSearchViews& views, const RimEdges& edges,
                            std::span<const DishModel> candidates, std::span<const FoundDish> taken,
                            const DishSearchParams& params, DishSearchWorkspace& workspace,
                            std::span<RimPeak> peaks);

}  // namespace traygauge
