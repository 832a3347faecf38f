// Refinement: the median of a square window (paper III-B-2).
#pragma once

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

inline constexpr int kMaxMedianRadius = 3;  // of profile paper's parameters; memory of 49 values

// Replaces each disparity by the median of the known ones around it; kNoDisparity stays. Equal sizes, not the
// same memory. Of an even number of known ones it takes the upper middle.
void filter_median(ImageView<const Disparity> source, int radius_px, ImageView<Disparity> target);

}  // namespace traygauge
