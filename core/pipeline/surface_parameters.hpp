// The parameters of dense matching, by name and with the values that they may have; more than one stage has
// them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "core/base/parameter_range.hpp"
#include "core/stereo/dense_stereo.hpp"
#include "core/stereo/median.hpp"

namespace traygauge {

// Hands every parameter on with `prefix` before its name, which is valid during the call alone.
template <class Visit>
class PrefixedVisit {
 public:
  PrefixedVisit(const char* prefix, Visit& visit) : prefix_(prefix), visit_(visit) {}

  template <class Field, class... Domain>
  void operator()(const char* name, Field& field, const Domain&... domain) const {
    std::array<char, 96> full{};
    char* end = full.data();
    for (const char* part : {prefix_, name}) {
      const auto room = static_cast<std::size_t>(full.data() + full.size() - 1 - end);
      end = std::copy_n(part, std::min(std::strlen(part), room), end);
    }
    visit_(full.data(), field, domain...);
  }

 private:
  const char* prefix_;
  Visit& visit_;
};

// `Params` is TwoViewSurfaceParams, const or not.
template <class Params, class Visit>
void visit_two_view_surface(Params& surface, Visit&& visit) {
  auto& grid = surface.rectification;
  auto& matching = surface.semi_global;
  auto& consistency = surface.consistency;
  auto& gaps = surface.gaps;
  auto& refinement = surface.refinement;
  using Range = ParameterRange;
  visit("rectification.max_samples", grid.max_samples, Range{4096, 1 << 20});
  visit("rectification.whole_dish", grid.whole_dish);
  visit("rectification.max_rows", grid.max_rows, Range{16, 4096});
  visit("rectification.aspect", grid.aspect, Range{0.1, 10});
  visit("rectification.least_step_px", grid.least_step_px, Range{0, 100});
  visit("rectification.margin_samples", grid.margin_samples, Range{0, 64});
  visit("rectification.max_fan", grid.max_fan, Range{1, 1000});
  visit("rectification.max_samples_per_axis", grid.max_samples_per_axis, Range{1, kMaxSamplesPerAxis});
  visit("rectification.outline_step_px", grid.outline_step_px, Range{1, 64});
  visit("max_columns", surface.max_columns, Range{16, 4096});
  visit("levels", surface.levels, Range{1, kMaxSurfaceLevels});
  visit("finest_level", surface.finest_level, Range{0, kMaxSurfaceLevels - 1});
  visit("band_lanes", surface.band_lanes, Range{kBandLanes, kMaxBandLanes, kBandLanes});
  visit("min_height_mm", surface.min_height_mm, Range{-40, 0});
  visit("highest_mm", surface.highest_mm, Range{5, 400});
  visit("median_radius", surface.median_radius, Range{0, kMaxMedianRadius});
  visit("confirmed_px", surface.confirmed_px, Range{0, 100});
  visit("semi_global.small_step_penalty", matching.small_step_penalty, Range{0, kMaxSmallStepPenalty});
  visit("semi_global.large_step_penalty", matching.large_step_penalty, Range{0, kMaxLargePenalty});
  visit("semi_global.least_large_penalty", matching.least_large_penalty, Range{0, kMaxLargePenalty});
  visit("semi_global.border_penalty", matching.border_penalty, Range{0, kMaxLargePenalty});
  visit("semi_global.edge_contrast", matching.edge_contrast, Range{1, 255});
  visit("semi_global.label_penalty", matching.label_penalty, Range{0, kMaxLabelPenalty});
  visit("semi_global.diagonal_paths", matching.diagonal_paths);
  visit("consistency.max_difference_px", consistency.max_difference_px, Range{0, 1000});
  visit("gaps.contact_share", gaps.contact_share, Range{0, 1});
  visit("gaps.limb_share", gaps.limb_share, Range{0, 1});
  visit("gaps.flank_run", gaps.flank_run, Range{-10, 10});
  visit("gaps.flank_run_spread", gaps.flank_run_spread, Range{1e-3, 10});
  visit("gaps.seen_wall_share", gaps.seen_wall_share, Range{0, 1});
  visit("gaps.limb_hull_share", gaps.limb_hull_share, Range{0, 1});
  visit("gaps.wall_lean", gaps.wall_lean, Range{-10, 10});
  visit("gaps.wall_lean_spread", gaps.wall_lean_spread, Range{1e-3, 10});
  visit("gaps.other_outline_share", gaps.other_outline_share, Range{0, 1});
  visit("gaps.same_surface_px", gaps.same_surface_px, Range{0, 1000});
  visit("gaps.step_share", gaps.step_share, Range{0, 1});
  visit("gaps.unmatched_fall_share", gaps.unmatched_fall_share, Range{0, 1});
  visit("refinement.iterations", refinement.iterations, Range{0, 50});
  visit("refinement.window_radius", refinement.window_radius, Range{1, kMaxRefinementRadius});
  visit("refinement.max_step_px", refinement.max_step_px, Range{0, 100});
  visit("refinement.stiffness", refinement.stiffness, Range{0, 1e6});
  visit("refinement.smoothings", refinement.smoothings, Range{0, 100});
  visit("refinement.smoothing_hold", refinement.smoothing_hold, Range{0, 1000});
  visit("refinement.relaxations", refinement.relaxations, Range{0, 100});
  visit("refinement.max_jump_px", refinement.max_jump_px, Range{0, 1000});
  visit("refinement.dish_weight", refinement.dish_weight, Range{0, 1});
  visit("refinement.outline_px", refinement.outline_px, Range{0, 1000});
  visit("refinement.border_tie", refinement.border_tie, Range{0, 1});
}

}  // namespace traygauge
