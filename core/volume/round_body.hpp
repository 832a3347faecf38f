// Whole fruit and other round bodies, whose skin is often plain and shines: there is little to match, and
// where a convex skin mirrors a lamp, the highlight lies below the surface, where a mirror shows things. But
// their outlines are limbs all around, and tell how high the body's middle is and how wide it is.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/dish/dish_profile.hpp"
#include "core/labels/label_set.hpp"
#include "core/volume/body_samples.hpp"
#include "core/volume/outline_rows.hpp"

namespace traygauge {

// The shares are of the height of the body's centre over the dish's bottom, unless said otherwise. Chosen on
// rendered fruit, scanned and made up, and on the foods of the captures, none of which may pass for a fruit.
struct RoundBodyParams {
  int min_rows = 12;                 // that show both ends in both views
  double min_usable_fraction = 0.5;  // of the rows that the item is in
  // Of a line of sight, over mm that it falls: where a view sees the body more from the side, rows cut it far
  // from upright, and their sections' middles do not lie at its height.
  double max_run = 0.85;
  double min_centre_mm = 5.0;    // over the dish's bottom
  double least_roundness = 0.6;  // centre height over half the body's width: heaps and slices lie lower,
  double most_roundness = 1.5;   // what stands on end higher
  double max_edge_rise = 0.3;    // of the dish under the outline: a liquid's outline lies on the dish
  // Mean over greatest bulge: an ellipse has 0.5 and a tube more, what has corners or notches less, a slice
  // of cake 0.37 to 0.43. Such an outline is no round body's if both views agree that more than max_sunken of
  // the middle lies below sunken_top of the body's top: 0.9 of slices does, of shiny fruit 0.4 at most.
  double least_fullness = 0.45;
  double sunken_top = 0.9;
  double max_sunken = 0.6;
  double contact_fraction = 0.3;  // of the greatest bulge: further out nothing touches the dish
  double flatness = 0.95;         // centre height over half the width, expected
  double flatness_sigma = 0.1;    // of its logarithm
  double outline_sigma = 0.03;    // of the logarithm of the height that outlines tell, times the elongation:
                                  // along a tube the same section errs everywhere alike
  double raise_quantile = 0.7;    // so much of what was matched around the summit lies below the body
  double min_raise_samples = 100.0;
  double max_raise = 1.15;
  double rim_fraction = 0.4;    // of the greatest bulge: what lies outside is the rim
  double above_rim = 0.1;       // matched so far above the body there: the edge of a cake
  double max_rim_above = 0.25;  // of the rim's matched samples
  double reach = 0.1;           // matched samples so near to the body stay where they are
};

struct RoundBodyWorkspace {
  std::span<OutlineRow> rows;
  std::span<OutlineChord> columns;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_rows, int max_columns) {
    rows = arena.template take<OutlineRow>(static_cast<std::size_t>(max_rows));
    columns = arena.template take<OutlineChord>(static_cast<std::size_t>(max_columns));
  }
};

// Both grids of a plane rectification with the memory of their points.
struct RoundBodyGrids {
  std::array<SurfaceGrid, 2> views;
  std::array<std::span<SurfacePoint>, 2> points;
};

// Moves the points of round bodies that overhang along their lines of sight onto an upright body with their
// outlines, which rests on the dish; returns their labels. Others stay as they are. The workspace holds the
// grids' rows and columns.
LabelSet shape_round_bodies(const RoundBodyGrids& grids, const InnerSurface& dish,
                            const RoundBodyParams& params, RoundBodyWorkspace& workspace);

}  // namespace traygauge
