// Parameters of dense matching (paper III-B-2).
#pragma once

#include <cstdint>

namespace traygauge {

enum class MatchingCost : std::uint8_t { census, sad, zncc };

struct StereoParams {
  MatchingCost cost = MatchingCost::census;
  int census_radius_px = 3;  // 1 … 4; 7 × 7 census: 48 bits
  int sad_limit = 48;        // grey values; a difference beyond it is an outlier, not more evidence. As many
                             // units as the census has bits, so that the same smoothness serves both
  double zncc_weight =
      24.0;                  // cost of a pixel at correlation 0: half the bits, as between unrelated censuses
  int window_radius_px = 2;  // 0 … 4; aggregation window 5 × 5
  int levels = 4;            // of the pyramid, the finest included
  int band_px = 3;           // search around the coarser level's disparity, each side
  int band_reach_px = 1;     // coarse pixels around a pixel whose disparities its band includes
  double smoothness =
      8.0;  // cost of one pixel of disparity change in a uniform area, in cost units of one pixel
  double smoothness_deviation = 8.0;  // local standard deviation (grey values) at which that cost has halved
  int smoothness_limit_px = 16;       // a step beyond it costs no more: a depth edge
  int variance_radius_px = 3;         // window of the local variance
  int median_radius_px = 2;           // 0: no median
  bool subpixel = true;
};

}  // namespace traygauge
