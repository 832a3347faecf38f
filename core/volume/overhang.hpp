// The closed volume of round items that overhang: whole fruit, not heaps or cuts.
#pragma once

#include <span>

#include "core/labels/label_set.hpp"
#include "core/stereo/surface_grid.hpp"
#include "core/volume/height_map.hpp"
#include "core/volume/height_volume.hpp"

namespace traygauge {

struct OverhangParams {
  // A view tilted by t sees the dish under a ball's near side over about 0.8 r tan t of depth, under a wall
  // over none. Of what a ball of the item's size and height shows, the undercut's area of walls with noise
  // reaches the first share (rendered foods: 0.27, one in 560 0.39), that of fruit the second (0.68 and
  // more); between them it may be either.
  double wall_undercut_fraction = 0.3;
  double fruit_undercut_fraction = 0.65;
  // Column volume over closed volume: the middle of what scanned fruit has, 1.14 to 1.24; a ball has 1.25.
  double column_over_closed = 1.19;
  double min_undercut_mm2 = 30.0;  // what a few wrong samples make; nearly vertical views never show more
};

// Sets `volume_ml` of items that overhang to that of fruit with such columns: mirroring the upper side at the
// equator takes up to twice as much away from scanned fruit as it should, which is flat where it rests. Of
// those that may overhang it is the expected one, as unsure as `closing_sigma_ml` says. What is in `round`
// overhangs whether or not a view sees below it. Others keep their column volume. After integrate_height_map.
void close_overhangs(std::span<const SurfaceGrid> views, const HeightMap& map, const InnerSurface& dish,
                     const LabelSet& round, const OverhangParams& params, std::span<HeightVolume> items);

}  // namespace traygauge
