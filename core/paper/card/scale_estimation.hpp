// The scale of the sparse cloud from the card (paper III-A-3).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/paper/card/card_scale.hpp"

namespace traygauge::paper {

struct ScaleEstimate {
  double mm_per_baseline = 0.0;
  int pairs = 0;        // of points, whose ratios were used
  double spread = 0.0;  // interquartile range of the ratios over the scale
};

// The mode of the ratios of distances on the pattern (mm) over distances in the sparse cloud (baselines),
// over pairs of inliers; ScaleParams::method has the alternatives. scale_not_found with too few pairs or when
// the ratios scatter too much. O(pairs log pairs), drawn at random when the workspace cannot hold all.
Status estimate_scale(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
                      double card_length_mm, const CardScaleParams& params, Random& random,
                      CardScaleWorkspace& workspace, ScaleEstimate& estimate);

}  // namespace traygauge::paper
