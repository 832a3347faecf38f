// The census transform and the Hamming distance of its bits (paper III-B-2, [32]).
#pragma once

#include <span>

#include "core/paper/stereo/block_rows.hpp"
#include "core/paper/stereo/row_block.hpp"

namespace traygauge::paper {

// A square of radius r has (2r + 1)² − 1 = 8 · r (r + 1) / 2 neighbours: whole bytes.
constexpr int census_bytes(int radius_px) {
  return radius_px * (radius_px + 1) / 2;
}

// A bit per neighbour, 1 where it is greater than the centre: census_bytes() byte planes a column.
// Beyond the picture its border is repeated.
void transform_census(const BlockPicture& block, int radius_px, std::span<ByteLanes> codes);

// Number of differing bits between one column of the first picture and `count` successive columns of the
// second.
void hamming_distances(const ByteLanes* first, const ByteLanes* second, int radius_px, int count,
                       ByteLanes* distances);

}  // namespace traygauge::paper
