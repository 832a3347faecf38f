// What both views agree on.
#pragma once

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

struct ConsistencyParams {
  double max_difference_px = 1.5;  // between a disparity and its partner's: whole pixels and half a step
};

// Drops the disparities that the other view contradicts. `sign` is +1 for the first view, whose partner lies
// at column + disparity, −1 for the second.
void keep_consistent(ImageView<const Disparity> own, ImageView<const Disparity> other, int sign,
                     const ConsistencyParams& params, ImageView<Disparity> kept);

}  // namespace traygauge
