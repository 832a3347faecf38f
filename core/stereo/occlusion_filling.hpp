// What stands in where the views do not agree: between what is known of an item, and from there to its
// outline.
#pragma once

#include <cstdint>
#include <span>

#include "core/stereo/disparity.hpp"

namespace traygauge {

// Angles are leans: how far a line of sight leans out over an outline, as run over rise; below 0 the camera
// looks at it from outside. The shares that follow were compared with true heights at 8200 ends of rows on
// outlines of rendered meals (tests/evaluation/experiments.md, Gaps at outlines, which has what other values
// give). Half or twice of one moves the MAPE of six pairs of the captures by 0.07 points at most, but for
// twice of same_surface_px: 0.16 (numbers.tsv).
struct OcclusionParams {
  // On an item's side that the other view sees more of: of its last known height what its flank has where its
  // outline ends, next to nothing where the view sees down to the foot; where it looks over the item, the
  // outline is a limb. Items differ in their flanks' run over rise, so far to either side it counts as partly
  // both; so does an outline that a view looks along.
  double contact_fraction = 0.15;
  double limb_fraction = 0.6;
  double flank_run = 0.2;
  double lean_spread = 0.1;
  // On the side that this view sees more of, no sample lies beyond the other view's outline, which bounds its
  // height (visual hull; Laurentini, PAMI 16, 1994). Of that bound the outline has this share where the view
  // looks at a wall from outside, down to its foot, and all of it where it looks over the wall.
  double seen_wall_fraction = 0.3;
  // Of its last known height what the item has at the other view's outline where the bound is nothing; all of
  // it where the bound is its height.
  double other_outline_fraction = 0.25;
  double same_surface_px =
      kOneSurfacePx;  // ends of a gap that differ by less are one surface seen through it
  // Where they differ by more and neither hides the gap from the other view: between the straight line (1)
  // and the lower end going on (0).
  double step_fraction = 0.5;
  // A gap that one end hides from the other view is as wide as the step. What it is wider by both views see,
  // and could not match, as on steep and glossy sides: over so much of that it falls. 0: it falls at once, as
  // a wall does; 1: what was not matched is all slope.
  double unmatched_fall_fraction = 0.5;
};

// A camera over a row: the column of its foot, and its height in columns.
struct CameraOverRow {
  double foot_column = 0.0;
  double height_columns = 1.0;

  // Of its line of sight to a column, towards `side` (−1 or 1) of the row.
  constexpr double lean(double column, int side) const {
    return side * (column - foot_column) / height_columns;
  }
};

// The same row in both views.
struct RowOfViews {
  std::span<const std::uint8_t> labels;
  std::span<const std::uint8_t> other_labels;
  int sign = 1;  // a sample's partner lies at column + sign · disparity
  CameraOverRow camera;
  CameraOverRow other_camera;
};

// How the view's lines of sight lean out over an outline that may cross the rows at any angle.
class ViewSlope {
 public:
  // Of the item that ends at a column of the row, on `side` of it; along the outline's normal.
  virtual double at(int column, int side) const = 0;

 protected:
  ~ViewSlope() = default;
};

// Fills a row's samples with a label and no disparity from the nearest known ones of the same label on either
// side: between them when they lie on one surface; where an item hides a part of itself from the other view,
// down an upright wall as far as this view sees it or a slope that was not matched, then along the lower
// surface; the lower one where the label is the dish's, whose surface goes on behind; towards an item's
// outline, as its flank falls there.
void fill_occlusions(const RowOfViews& row, const ViewSlope& outline, const OcclusionParams& params,
                     std::span<Disparity> disparity);

}  // namespace traygauge
