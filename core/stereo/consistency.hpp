// What both views agree on, and what stands in where they do not.
#pragma once

#include <array>
#include <cstdint>

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

struct ConsistencyParams {
  double max_difference_px = 1.5;  // between a disparity and its partner's: whole pixels and half a step
  // Of its last known height that an item's flank has where its outline ends: on the side that this view sees
  // and the other does not, most reach down to the dish; on the other side the outline is often a limb.
  double own_border_share = 0.15;
  double far_border_share = 0.65;
  double same_surface_px = 3.0;  // ends of a gap that differ by less are one surface seen through it; by
                                 // more, the gap is what the nearer one hides from the other view
  // The straight line across such a gap is the other view's line of sight past the nearer surface: what it
  // hides lies below, between the line (1) and the lower surface going on (0).
  double chord_share = 0.5;
};

// Drops the disparities that the other view contradicts. `sign` is +1 for the first view, whose partner lies
// at column + disparity, −1 for the second.
void keep_consistent(ImageView<const Disparity> own, ImageView<const Disparity> other, int sign,
                     const ConsistencyParams& params, ImageView<Disparity> kept);

// `sign` as there. Fills the samples with a label and no disparity along their row, from the nearest known
// ones of the same label on either side: between them when they lie on one surface; below the line between
// them where an item hides a part of itself; the lower one where the label is the dish's, whose surface goes
// on behind.
void fill_gaps(ImageView<const std::uint8_t> labels, int sign, const ConsistencyParams& params,
               ImageView<Disparity> disparity);

}  // namespace traygauge
