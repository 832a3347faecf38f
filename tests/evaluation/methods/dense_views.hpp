// Volumes from dense stereo of tracked corners and the card's plane: the two-view adaptation of M. Puri et
// al. (paper [24]). Harris corners are tracked, PRESAC finds the motion, windows are correlated, the point
// cloud is filtered, and its surface is integrated over the plane of the card.
#pragma once

#include <cstdint>

#include "tests/evaluation/methods/height_sweep.hpp"
#include "tests/evaluation/methods/pair_features.hpp"
#include "tests/evaluation/methods/presac.hpp"
#include "tests/evaluation/methods/tray_geometry.hpp"

namespace traygauge::tables {

// [24] follows corners through a video. Between two pictures the card's homography takes out most of the
// motion, and a tracker follows the rest. `by_sift` gives the card's points, which stand for [24]'s large
// reference patterns.
PairMatches track_corners(const CaptureSession& session, const PairMatches& by_sift);

// `tracks`: of track_corners().
Run measure_dense_views(CaptureSession& session, const PairMatches& tracks, std::uint64_t seed,
                        const SweepParams& params = {});

}  // namespace traygauge::tables
