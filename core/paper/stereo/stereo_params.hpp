// Parameters of dense matching (paper III-B-2). The paper names the steps, not their constants: the defaults
// are measured on half of the rendered captures and confirmed on the other half and on real photographs;
// within a factor of two of each, the volume error changes by less than 0.3 %.
#pragma once

#include <cstdint>

#include "core/base/status.hpp"

namespace traygauge::paper {

enum class MatchingCost : std::uint8_t { census, sad, zncc };

struct StereoParams {
  MatchingCost cost = MatchingCost::census;
  // 1 … 4; 3: 48 comparisons. Smaller ones blur less, larger ones bear more noise.
  int census_radius_px = 3;
  // 1 … 255 grey values; a difference beyond it is an outlier, not more evidence. As many units as the census
  // has bits, so that the same smoothness serves both.
  int sad_limit = 48;
  // 0 … 48; cost of a pixel at correlation 0: half the bits, as between unrelated censuses.
  double zncc_weight = 24.0;
  // 0 … 4; 1: sums over 3 × 3 pixels, each with its census around it. Larger ones spread the foreground over
  // depth edges: 9 × 9 raises the median error by a quarter.
  int window_radius_px = 1;
  // 1 … 6 of the pyramid, the finest included. At 4 the coarsest dish measures 50 px. More levels change
  // nothing.
  int levels = 4;
  // 0 or more; search around the coarser level's disparity, each side.
  int band_px = 3;
  // 0 or more; coarse pixels around a pixel whose disparities its band includes. At 0 a small item next to a
  // large step is lost with its coarse pixel.
  int band_reach_px = 1;
  // 0 or more; cost of one pixel of disparity change in a uniform area, in local costs (bits) of one pixel.
  double smoothness = 8.0;
  // Above 0; local standard deviation in grey values at which that cost has halved: just above a camera's
  // noise.
  double smoothness_deviation = 4.0;
  // 1 … 8; window of the local variance.
  int variance_radius_px = 3;
  // 0 … 3; 0: no median.
  int median_radius_px = 2;
};

// invalid_configuration when a value lies outside its range.
Status validate(const StereoParams& params);

}  // namespace traygauge::paper
