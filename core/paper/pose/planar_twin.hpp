// The other motion that a plane allows.
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/paper/pose/match_table.hpp"

namespace traygauge::paper {

// Matches of a plane determine a homography, which splits into two motions (Faugeras and Lustman 1988). Given
// one of them and the matches, lays a plane through the scene and returns the other, with unit translation. A
// tray with a card and a low dish is nearly that case: both motions then fit nearly as well. False when the
// matches hold no plane or the two motions coincide.
bool find_planar_twin(const MatchTable& matches, std::span<const std::uint32_t> indices,
                      const Pose& second_from_first, Pose& twin_second_from_first);

}  // namespace traygauge::paper
