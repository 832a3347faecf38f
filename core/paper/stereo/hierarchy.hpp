// From coarse to fine: the coarsest level searches the whole range, each finer one a band around what the
// level before it found (paper III-B-2, "Optimization"; [34]).
#pragma once

#include <span>

#include "core/image_view/image_view.hpp"
#include "core/paper/stereo/block_rows.hpp"
#include "core/paper/stereo/stereo_params.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge::paper {

inline constexpr int kMaxLevels = 6;

// The whole range in pixels of a level, 0 being the finest.
DisparityRange range_at_level(DisparityRange range, int level);

// Every column of `columns` may take the whole range.
void open_bands(DisparityRange range, Interval columns, std::span<Interval> bands);

// The bands that the rows top … top + kRowLanes − 1 share: band_px around every disparity that the coarser
// level found within band_reach_px of their pixels. At a depth edge that spans both sides, and a row that
// went astray is led back by its neighbours. Columns without a coarse disparity take the nearest band.
void narrow_bands(ImageView<const Disparity> coarse, int top, DisparityRange range,
                  const StereoParams& params, Interval columns, std::span<Interval> bands);

}  // namespace traygauge::paper
