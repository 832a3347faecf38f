// The parameters of profile `best` from dense matching on, by name and with the values that they may have.
#pragma once

#include "core/base/parameter_range.hpp"
#include "core/pipeline/best_params.hpp"
#include "core/pipeline/surface_parameters.hpp"

namespace traygauge {

// As in sparse_parameters.hpp.
template <class Params, class Visit>
void visit_surface_parameters(Params& best, Visit&& visit) {
  visit("best.matte.gloss_share", best.matte.gloss_share, ParameterRange{0, 1});
  visit_two_view_surface(best.surface, PrefixedVisit("best.surface.", visit));
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
  visit("best.round_body.least_fullness", body.least_fullness, Range{0, 1});
  visit("best.round_body.sunken_top", body.sunken_top, Range{0, 10});
  visit("best.round_body.max_sunken", body.max_sunken, Range{0, 1});
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
  visit("best.volume.wall_slope", best.volume.wall_slope, Range{0, 100});
  visit("best.overhang.wall_undercut_share", best.overhang.wall_undercut_share, Range{0, 1000});
  visit("best.overhang.fruit_undercut_share", best.overhang.fruit_undercut_share, Range{0, 1000});
  visit("best.overhang.column_over_closed", best.overhang.column_over_closed, Range{1, 10});
  visit("best.overhang.min_undercut_mm2", best.overhang.min_undercut_mm2, Range{0, 1e6});
  visit("best.agreement.min_share", best.agreement.min_share, Range{0, 1});
  visit("best.agreement.step", best.agreement.step, Range{1, 64});
  visit("best.uncertainty.disparity_bias_px", sigma.disparity_bias_px, Range{0, 100});
  visit("best.uncertainty.height_mm", sigma.height_mm, Range{0, 100});
  visit("best.uncertainty.hidden_share", sigma.hidden_share, Range{0, 100});
  visit("best.uncertainty.outline_px", sigma.outline_px, Range{0, 100});
  visit("best.uncertainty.found_outline_mm", sigma.found_outline_mm, Range{0, 100});
  visit("best.uncertainty.wall_mm", sigma.wall_mm, Range{0, 100});
  visit("best.uncertainty.filled_share", sigma.filled_share, Range{0, 100});
  visit("best.uncertainty.round_share", sigma.round_share, Range{0, 100});
  visit("best.pipeline.summit_margin_mm", pipeline.summit_margin_mm, Range{0, 400});
  visit("best.pipeline.min_top_mm", pipeline.min_top_mm, Range{0, 400});
  visit("best.pipeline.min_rim_inlier_share", pipeline.min_rim_inlier_share, Range{0, 1});
  visit("best.pipeline.max_sigma_share", pipeline.max_sigma_share, Range{0, 100});
  visit("best.pipeline.min_matched_share", pipeline.min_matched_share, Range{0, 1});
  visit("best.pipeline.max_outline_points", pipeline.max_outline_points, Range{16, 65536});
  visit("best.pipeline.max_contour_sides", pipeline.max_contour_sides, Range{256, 1 << 20});
  visit("best.pipeline.max_height_cells", pipeline.max_height_cells, Range{1024, 1 << 22});
}

}  // namespace traygauge
