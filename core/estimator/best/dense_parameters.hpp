// The parameters of profile `best` from dense matching on, by name and with the values that they may have.
#pragma once

#include "core/base/parameter_range.hpp"
#include "core/estimator/best/best_params.hpp"
#include "core/stereo/median.hpp"

namespace traygauge {

// As in sparse_parameters.hpp.
template <class Params, class Visit>
void visit_surface_parameters(Params& best, Visit&& visit) {
  auto& surface = best.surface;
  auto& grid = surface.rectification;
  using Range = ParameterRange;
  visit("best.matte.gloss_share", best.matte.gloss_share, Range{0, 1});
  visit("best.surface.rectification.max_samples", grid.max_samples, Range{4096, 1 << 20});
  visit("best.surface.rectification.max_rows", grid.max_rows, Range{16, 4096});
  visit("best.surface.rectification.aspect", grid.aspect, Range{0.1, 10});
  visit("best.surface.rectification.margin_samples", grid.margin_samples, Range{0, 64});
  visit("best.surface.rectification.max_fan", grid.max_fan, Range{1, 1000});
  visit("best.surface.rectification.max_samples_per_axis", grid.max_samples_per_axis,
        Range{1, kMaxSamplesPerAxis});
  visit("best.surface.rectification.outline_step_px", grid.outline_step_px, Range{1, 64});
  visit("best.surface.max_columns", surface.max_columns, Range{16, 4096});
  visit("best.surface.levels", surface.levels, Range{1, kMaxSurfaceLevels});
  visit("best.surface.finest_level", surface.finest_level, Range{0, kMaxSurfaceLevels - 1});
  visit("best.surface.band_lanes", surface.band_lanes, Range{kBandLanes, kMaxBandLanes, kBandLanes});
  visit("best.surface.min_height_mm", surface.min_height_mm, Range{-40, 0});
  visit("best.surface.highest_mm", surface.highest_mm, Range{5, 400});
  visit("best.surface.median_radius", surface.median_radius, Range{0, kMaxMedianRadius});
  visit("best.surface.confirmed_px", surface.confirmed_px, Range{0, 100});
}

template <class Params, class Visit>
void visit_matching_parameters(Params& best, Visit&& visit) {
  auto& matching = best.surface.semi_global;
  auto& consistency = best.surface.consistency;
  auto& refinement = best.surface.refinement;
  using Range = ParameterRange;
  visit("best.surface.semi_global.small_step_penalty", matching.small_step_penalty,
        Range{0, kMaxSmallStepPenalty});
  visit("best.surface.semi_global.large_step_penalty", matching.large_step_penalty,
        Range{0, kMaxLargePenalty});
  visit("best.surface.semi_global.least_large_penalty", matching.least_large_penalty,
        Range{0, kMaxLargePenalty});
  visit("best.surface.semi_global.border_penalty", matching.border_penalty, Range{0, kMaxLargePenalty});
  visit("best.surface.semi_global.edge_contrast", matching.edge_contrast, Range{1, 255});
  visit("best.surface.semi_global.label_penalty", matching.label_penalty, Range{0, kMaxLabelPenalty});
  visit("best.surface.semi_global.diagonal_paths", matching.diagonal_paths);
  visit("best.surface.consistency.max_difference_px", consistency.max_difference_px, Range{0, 1000});
  visit("best.surface.consistency.contact_share", consistency.contact_share, Range{0, 1});
  visit("best.surface.consistency.limb_share", consistency.limb_share, Range{0, 1});
  visit("best.surface.consistency.flank_run", consistency.flank_run, Range{-10, 10});
  visit("best.surface.consistency.flank_run_spread", consistency.flank_run_spread, Range{1e-3, 10});
  visit("best.surface.consistency.chord_share", consistency.chord_share, Range{0, 1});
  visit("best.surface.consistency.same_surface_px", consistency.same_surface_px, Range{0, 1000});
  visit("best.surface.refinement.iterations", refinement.iterations, Range{0, 50});
  visit("best.surface.refinement.window_radius", refinement.window_radius, Range{1, kMaxRefinementRadius});
  visit("best.surface.refinement.max_step_px", refinement.max_step_px, Range{0, 100});
  visit("best.surface.refinement.stiffness", refinement.stiffness, Range{0, 1e6});
  visit("best.surface.refinement.smoothings", refinement.smoothings, Range{0, 100});
  visit("best.surface.refinement.smoothing_hold", refinement.smoothing_hold, Range{0, 1000});
  visit("best.surface.refinement.relaxations", refinement.relaxations, Range{0, 100});
  visit("best.surface.refinement.max_jump_px", refinement.max_jump_px, Range{0, 1000});
  visit("best.surface.refinement.dish_weight", refinement.dish_weight, Range{0, 1});
  visit("best.surface.refinement.outline_px", refinement.outline_px, Range{0, 1000});
  visit("best.surface.refinement.border_tie", refinement.border_tie, Range{0, 1});
}

template <class Params, class Visit>
void visit_height_parameters(Params& best, Visit&& visit) {
  auto& map = best.height_map;
  using Range = ParameterRange;
  visit("best.height_map.cell_mm", map.cell_mm, Range{0.1, 20});
  visit("best.height_map.jump_cosine", map.jump_cosine, Range{0, 0.9});
  visit("best.height_map.disagreement_mm", map.disagreement_mm, Range{0, 200});
  visit("best.height_map.undercut_mm", map.undercut_mm, Range{0, 200});
  visit("best.height_map.min_flank_threshold", map.min_flank_threshold, Range{0.01, 100});
  visit("best.height_map.max_flank_threshold", map.max_flank_threshold, Range{0.01, 100});
  visit("best.height_map.prior_flank_mm2", map.prior_flank_mm2, Range{0.01, 1e5});
  visit("best.height_map.hidden_steepness", map.hidden_steepness, Range{0.1, 100});
  visit("best.height_map.max_hole_mm", map.max_hole_mm, Range{0, 200});
  visit("best.liquid.contact_tolerance_mm", best.liquid.contact_tolerance_mm, Range{0.01, 50});
  visit("best.liquid.min_contact_share", best.liquid.min_contact_share, Range{0, 1});
  visit("best.liquid.max_contact_difference_mm", best.liquid.max_contact_difference_mm, Range{0, 200});
  visit("best.liquid.solid_sigmas", best.liquid.solid_sigmas, Range{0, 100});
  visit("best.liquid.min_solid_mm", best.liquid.min_solid_mm, Range{0, 200});
  visit("best.liquid.tolerance_mm", best.liquid.tolerance_mm, Range{0.01, 50});
  visit("best.liquid.min_level_share", best.liquid.min_level_share, Range{0, 1});
  visit("best.liquid.max_gap_mm", best.liquid.max_gap_mm, Range{0, 200});
  visit("best.liquid.min_wall_share", best.liquid.min_wall_share, Range{0, 1});
  visit("best.liquid.min_depth_mm", best.liquid.min_depth_mm, Range{0, 200});
}

template <class Params, class Visit>
void visit_round_body_parameters(Params& best, Visit&& visit) {
  auto& body = best.round_body;
  using Range = ParameterRange;
  visit("best.round_body.min_rows", body.min_rows, Range{1, 4096});
  visit("best.round_body.min_usable_share", body.min_usable_share, Range{0, 1});
  visit("best.round_body.max_run", body.max_run, Range{0, 10});
  visit("best.round_body.min_centre_mm", body.min_centre_mm, Range{0, 200});
  visit("best.round_body.least_roundness", body.least_roundness, Range{0, 1});
  visit("best.round_body.most_roundness", body.most_roundness, Range{0, 100});
  visit("best.round_body.max_edge_rise", body.max_edge_rise, Range{0, 10});
  visit("best.round_body.contact_share", body.contact_share, Range{0.01, 0.99});
  visit("best.round_body.flatness", body.flatness, Range{0.1, 10});
  visit("best.round_body.flatness_sigma", body.flatness_sigma, Range{1e-3, 100});
  visit("best.round_body.outline_sigma", body.outline_sigma, Range{1e-3, 100});
  visit("best.round_body.raise_quantile", body.raise_quantile, Range{0, 1});
  visit("best.round_body.min_raise_samples", body.min_raise_samples, Range{1, 1e6});
  visit("best.round_body.max_raise", body.max_raise, Range{1, 10});
  visit("best.round_body.rim_share", body.rim_share, Range{0, 1});
  visit("best.round_body.above_rim", body.above_rim, Range{0, 10});
  visit("best.round_body.max_rim_above", body.max_rim_above, Range{0, 1});
  visit("best.round_body.reach", body.reach, Range{1e-3, 10});
}

template <class Params, class Visit>
void visit_volume_parameters(Params& best, Visit&& visit) {
  auto& sigma = best.uncertainty;
  auto& pipeline = best.pipeline;
  using Range = ParameterRange;
  visit("best.volume.max_height_ignored_mm2", best.volume.max_height_ignored_mm2, Range{0, 1e5});
  visit("best.overhang.min_undercut_share", best.overhang.min_undercut_share, Range{0, 1000});
  visit("best.overhang.column_over_closed", best.overhang.column_over_closed, Range{1, 10});
  visit("best.overhang.min_undercut_mm2", best.overhang.min_undercut_mm2, Range{0, 1e6});
  visit("best.agreement.min_share", best.agreement.min_share, Range{0, 1});
  visit("best.agreement.step", best.agreement.step, Range{1, 64});
  visit("best.uncertainty.disparity_bias_px", sigma.disparity_bias_px, Range{0, 100});
  visit("best.uncertainty.hidden_share", sigma.hidden_share, Range{0, 100});
  visit("best.uncertainty.outline_px", sigma.outline_px, Range{0, 100});
  visit("best.uncertainty.surface_share", sigma.surface_share, Range{0, 100});
  visit("best.uncertainty.steepness_share", sigma.steepness_share, Range{0, 100});
  visit("best.uncertainty.filled_share", sigma.filled_share, Range{0, 100});
  visit("best.uncertainty.round_share", sigma.round_share, Range{0, 100});
  visit("best.uncertainty.dish_height_mm", sigma.dish_height_mm, Range{0, 100});
  visit("best.pipeline.summit_margin_mm", pipeline.summit_margin_mm, Range{0, 400});
  visit("best.pipeline.min_top_mm", pipeline.min_top_mm, Range{0, 400});
  visit("best.pipeline.min_rim_inlier_share", pipeline.min_rim_inlier_share, Range{0, 1});
  visit("best.pipeline.min_matched_share", pipeline.min_matched_share, Range{0, 1});
  visit("best.pipeline.max_outline_points", pipeline.max_outline_points, Range{16, 65536});
  visit("best.pipeline.max_contour_sides", pipeline.max_contour_sides, Range{256, 1 << 20});
  visit("best.pipeline.max_height_cells", pipeline.max_height_cells, Range{1024, 1 << 22});
}

}  // namespace traygauge
