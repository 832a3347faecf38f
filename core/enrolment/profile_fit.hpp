// A dish's profile through the heights of its rings: from the outer edge up to the rim's crest, down without
// rising to the flat bottom, in few points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/dish/dish_profile.hpp"
#include "core/enrolment/inset_heights.hpp"

namespace traygauge {

struct ProfileFitParams {
  // The crest lies so near to the edge at most: rims are rounded, not flat.
  double crest_reach_mm = 8.0;
  // Rings nearer to the edge than this mix with what lies below it.
  double edge_margin_mm = 1.5;
  // Rings within so much of the bottom's level belong to it: noise, and bottoms that are not quite flat.
  double flat_mm = 0.35;
  // Of the smaller half axis, from the middle: where the bottom's level is looked for first. A dish of which
  // nothing is known there has no profile.
  double bottom_fraction = 0.3;
  double smoothing_mm = 1.6;    // reach of the straight line through a ring's neighbours
  double tolerance_mm = 0.1;    // between points and rings; no more points are added below it
  double min_spacing_mm = 1.5;  // of points
  std::size_t max_points = 14;
  double min_known_fraction = 0.5;  // of the rings; fewer: too_little_depth
  double max_gap_mm = 15.0;         // between known rings; a wall could turn within more
  double max_residual_mm = 0.4;     // more: what was matched is no dish's surface
  double least_sigma_mm = 0.05;     // of a ring: matching errors that all its samples share
};

struct FittedProfile {
  DishModel dish;               // round or oval as the edge; label 1
  double residual_mm = 0.0;     // root mean square of the known rings about the profile, by their weight
  double spread_mm = 0.0;       // of the samples within a ring, root mean square
  double known_fraction = 0.0;  // of the rings
  double widest_gap_mm = 0.0;
};

struct ProfileFitWorkspace {
  std::span<double> levels_mm;  // of the rings, never rising inward
  std::span<double> weights;
  std::span<std::uint32_t> blocks;

  template <class Allocator>
  constexpr void allocate(Allocator& arena) {
    levels_mm = arena.template take<double>(kMaxInsetRings);
    weights = arena.template take<double>(kMaxInsetRings);
    blocks = arena.template take<std::uint32_t>(kMaxInsetRings);
  }
};

// `edge` gives the outer size and, as rim height, that of the outer edge. too_little_depth when too few rings
// are known, they leave too wide a gap, or no profile goes through them; `fitted` then says how they are.
Status fit_dish_profile(std::span<const InsetRing> rings, const DishModel& edge,
                        const ProfileFitParams& params, ProfileFitWorkspace& workspace,
                        FittedProfile& fitted);

}  // namespace traygauge
