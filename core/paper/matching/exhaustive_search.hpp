// Nearest neighbours by comparing everything with everything, both directions in one pass.
#pragma once

#include <cstdint>
#include <span>

#include "core/paper/features/keypoint.hpp"
#include "core/paper/matching/neighbours.hpp"
#include "core/paper/matching/packed_descriptors.hpp"

namespace traygauge::paper {

// Finds the `count` nearest of every feature of either picture. `packed` holds the second picture's blocks;
// `rows` (first picture's size) and `column_limits` (a float a slot) are scratch; both lists are cleared.
void search_exhaustively(const FeatureSet& first, const PackedDescriptors& packed, int count,
                         std::span<std::int32_t> rows, std::span<float> column_limits,
                         std::span<Neighbours> of_first, std::span<Neighbours> of_second);

}  // namespace traygauge::paper
