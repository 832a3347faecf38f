// What both views agree on.
#pragma once

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

// Drops the disparities from which those of the other view differ by more than 1.5 pixels. `sign` is +1 for
// the first view, whose partner lies at column + disparity, −1 for the second.
void keep_consistent(ImageView<const Disparity> own, ImageView<const Disparity> other, int sign,
                     ImageView<Disparity> kept);

}  // namespace traygauge
