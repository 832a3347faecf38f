// Dense matching of a rectified pair: census, square window, hierarchical dynamic programming with a
// smoothness that falls with the local variance, median (paper III-B-2; [32] census, [34] hierarchical
// dynamic programming).
#pragma once

#include <cstdint>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

enum class MatchingCost : std::uint8_t { census, sad, zncc };

struct StereoParams {
  MatchingCost cost = MatchingCost::census;
  int census_radius_px = 3;  // 7 × 7 census: 48 bits
  int window_radius_px = 2;  // aggregation window 5 × 5
  int levels = 4;            // of the pyramid, the finest included
  int band_px = 3;           // search around the coarser level's disparity, each side
  double smoothness =
      8.0;  // cost of one pixel of disparity change in a uniform area, in cost units of one pixel
  double smoothness_deviation = 8.0;  // local standard deviation (grey values) at which that cost has halved
  int variance_radius_px = 3;         // window of the local variance
  int median_radius_px = 2;
  bool subpixel = true;
};

}  // namespace traygauge
