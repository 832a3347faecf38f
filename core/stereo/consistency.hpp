// What both views agree on, and what stands in where they do not.
#pragma once

#include <array>
#include <cstdint>

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

struct ConsistencyParams {
  double max_difference_px = 1.5;  // between a disparity and its partner's: whole pixels and half a step
  double border_share = 0.65;      // of its last known height that an item's hidden flank has where its
                                   // outline ends; the mean over the captures' flanks
  double same_surface_px = 3.0;    // ends of a gap that differ by less are one surface seen through it; by
                                   // more, the gap is what the nearer one hides from the other view
};

// Drops the disparities that the other view contradicts. `sign` is +1 for the first view, whose partner lies
// at column + disparity, −1 for the second.
void keep_consistent(ImageView<const Disparity> own, ImageView<const Disparity> other, int sign,
                     const ConsistencyParams& params, ImageView<Disparity> kept);

// Fills the samples with a label and no disparity along their row, from the nearest known ones of the same
// label on either side: between them when they lie on one surface or the label is an item's, whose hidden
// flank falls from one to the other; the lower one where it is the dish's, whose surface goes on behind.
void fill_gaps(ImageView<const std::uint8_t> labels, const ConsistencyParams& params,
               ImageView<Disparity> disparity);

}  // namespace traygauge
