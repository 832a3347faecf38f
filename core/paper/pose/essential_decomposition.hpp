// From an essential matrix to the motion that it stands for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/paper/pose/match_table.hpp"

namespace traygauge::paper {

// The four motions with unit translation that share an essential matrix of any scale and sign (H&Z 9.6.2):
// two rotations, each with both directions of the translation.
std::array<Pose, 4> decompose_essential(const Mat3& essential);

// How many of the indexed matches lie in front of both cameras, with a parallax of at least
// `min_parallax_rad` and at most a right angle.
std::size_t count_in_front(const MatchTable& matches, std::span<const std::uint32_t> indices,
                           const Pose& second_from_first, double min_parallax_rad);

}  // namespace traygauge::paper
