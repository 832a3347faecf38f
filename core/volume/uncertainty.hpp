// How sure a volume is, from what was measured.
#pragma once

#include "core/adjustment/bundle_adjustment.hpp"
#include "core/volume/height_volume.hpp"

namespace traygauge {

// Standard deviations of what the covariance of the cameras does not know. What they weigh together was
// fitted to the captures, seed 6 and 20 meals of seed 4, and reduced alike on seed 7
// (tests/evaluation/experiments.md, Sigma). tests/evaluation/fit/fit_uncertainty.py fits again: 172 volumes
// of the captures, meals-14 and trays-8 hardly tell disparity, walls and height apart. They give 0 px, 0 mm
// and 0.17 mm, 0.25 of hidden volume, 0.77 of a sample, 0.34 of the squared filled share, and cover neither
// more of these sets nor of one left out.
struct UncertaintyParams {
  double disparity_bias_px = 0.028;  // of an item's mean disparity: smooth skin, gloss, slanted windows
  // Of an item's whole surface over the dish: how the dish was fired and glazed, and what follows the food.
  double height_mm = 0.135;
  double hidden_fraction = 0.167;  // of the volume that no view sees
  double outline_px = 0.725;       // of an item's outline, all along it: about a sample of the grid
  // The same where a segmentation found it, beside that: what it moves the volumes of rendered meals by, 68
  // of 100 by less. The three sets above give 0.75 mm.
  double found_outline_mm = 0.55;
  double wall_mm = 0.214;  // of walls within an item, which are matched too far in or out together
  // Of the volume, times the squared share that was filled instead of matched: the wider a gap, the less its
  // rims say about it.
  double filled_fraction = 0.326;
  // Of the volume of a round body, instead: its height and width are those of its outlines. From fruit
  // rendered for this, and from how closed and column volume of scanned fruit differ.
  double round_fraction = 0.05;
};

// What an item's uncertainty follows from.
struct UncertaintyInput {
  HeightVolume volume;
  double matched_fraction = 1.0;  // of its samples
  double height_per_px_mm = 0.0;  // of disparity
  double px_mm = 0.0;             // of the samples, on the dish
  bool is_round = false;          // shaped by its outlines
  bool is_outline_found = false;  // not drawn by a person
  double dish_sigma_mm = 0.0;     // of the height of the dish under the item, beside what dishes differ by
};

// Standard deviation of the height of a point that both cameras see, as far as the cameras' covariance goes.
double height_sigma_mm(const Vec3& point_mm, const TableCameras& camera_from_table,
                       const BundleMatrix& covariance);

// Standard deviation of the volume, ml.
double estimate_sigma_ml(const UncertaintyInput& input, const TableCameras& camera_from_table,
                         const BundleMatrix& covariance, const UncertaintyParams& params);

}  // namespace traygauge
