// What both views agree on, and what stands in where they do not.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/stereo/disparity.hpp"

namespace traygauge {

struct ConsistencyParams {
  double max_difference_px = 1.5;  // between a disparity and its partner's: whole pixels and half a step
  // Of its last known height that an item's flank has where its outline ends: next to nothing where the view
  // sees down to the foot; where it looks over the item, the outline is a limb.
  double contact_share = 0.15;
  double limb_share = 0.6;
  // Run over rise of an item's steep flanks: lines of sight from the other side that lean out by more pass
  // over them. Items differ; so far to either side the outline counts as partly both.
  double flank_run = 0.2;
  double flank_run_spread = 0.1;
  double same_surface_px = 5.0;  // ends of a gap that differ by less are one surface seen through it; by
                                 // more, the gap is what the nearer one hides from the other view
  // The straight line across such a gap is the other view's line of sight past the nearer surface: what it
  // hides lies below, between the line (1) and the lower surface going on (0).
  double chord_share = 0.5;
};

// Drops the disparities that the other view contradicts. `sign` is +1 for the first view, whose partner lies
// at column + disparity, −1 for the second.
void keep_consistent(ImageView<const Disparity> own, ImageView<const Disparity> other, int sign,
                     const ConsistencyParams& params, ImageView<Disparity> kept);

// Where a view's camera stands over a row: the column of its foot, and its height in columns.
struct RowSight {
  double foot_column = 0.0;
  double height_columns = 1.0;
};

// Fills a row's samples with a label and no disparity from the nearest known ones of the same label on either
// side: between them when they lie on one surface; below the line between them where an item hides a part of
// itself; the lower one where the label is the dish's, whose surface goes on behind; towards an item's
// outline, as its flank falls there for the view's camera.
void fill_gaps(std::span<const std::uint8_t> labels, const RowSight& sight, const ConsistencyParams& params,
               std::span<Disparity> disparity);

}  // namespace traygauge
