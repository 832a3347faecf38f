// Volumes from one view and shape priors, as C. Xu et al. (paper [20]): the card gives the camera's pose; for
// each item the solid is sought whose silhouette covers its segment, its shape and proportions known
// beforehand.
#pragma once

#include <cstdint>

#include "tests/evaluation/methods/pair_features.hpp"
#include "tests/evaluation/methods/solid.hpp"
#include "tests/evaluation/methods/tray_geometry.hpp"

namespace traygauge::tables {

// [20] has a model for each class of food. Classes are not given here: the shape is chosen by the segment, a
// box where that overlaps clearly better than a rounded heap, and heights follow from the footprint. The two
// ratios are medians over 20 foods of captures that no set of the paper's tables holds, and were not fitted
// to those sets.
struct ShapePriors {
  double cap_height = 0.45;     // over the root of the footprint's area: heaps
  double box_height = 0.23;     // slabs
  double box_advantage = 0.02;  // of the overlap, to take a segment for a slab
};

// Of the pair's first view. Does not depend on the seed.
Run measure_single_view(CaptureSession& session, std::uint64_t seed, const ShapePriors& priors = {});

// The item's solid by its priors.
SilhouetteFit fit_prior(const ItemView& item, const ShapePriors& priors);

}  // namespace traygauge::tables
