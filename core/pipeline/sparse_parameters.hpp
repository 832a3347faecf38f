// The parameters of profile `best` up to the joint refinement, by name and with the values that they may
// have.
#pragma once

#include "core/base/parameter_range.hpp"
#include "core/pipeline/best_params.hpp"

namespace traygauge {

// Each calls visit(name, field, ParameterRange) for a number and visit(name, field) for a switch. `Params` is
// BestParams, const or not.
template <class Params, class Visit>
void visit_card_parameters(Params& best, Visit&& visit) {
  auto& card = best.card;
  using Range = ParameterRange;
  visit("best.card.pattern.max_level_px", card.pattern.max_level_px, Range{10'000, 4'000'000});
  visit("best.card.pattern.finest_px_per_mm", card.pattern.finest_px_per_mm, Range{1, 50});
  visit("best.card.pattern.finest_blur_px", card.pattern.finest_blur_px, Range{0.3, 5});
  visit("best.card.outline.max_points", card.outline.max_points, Range{64, 65536});
  visit("best.card.outline.min_side_px", card.outline.min_side_px, Range{4, 8192});
  visit("best.card.outline.near_px", card.outline.near_px, Range{0.1, 100});
  visit("best.card.outline.inlier_px", card.outline.inlier_px, Range{0.01, 100});
  visit("best.card.outline.corner_share", card.outline.corner_share, Range{0, 0.45});
  visit("best.card.outline.fit_rounds", card.outline.fit_rounds, Range{0, 100});
  visit("best.card.picture.max_tiles", card.picture.max_tiles, Range{16, 65536});
  visit("best.card.picture.erosion_px", card.picture.erosion_px, Range{0, 64});
  visit("best.card.refinement.cutoff_spreads", card.refinement.cutoff_spreads, Range{0.1, 1000});
  visit("best.card.refinement.min_spread_gray", card.refinement.min_spread_gray, Range{0.01, 255});
  visit("best.card.refinement.max_step_px", card.refinement.max_step_px, Range{0.01, 1000});
  visit("best.card.refinement.converged_px", card.refinement.converged_px, Range{0, 100});
  visit("best.card.refinement.min_samples", card.refinement.min_samples, Range{1, 1e6});
  visit("best.card.refinement.min_tilt_cosine", card.refinement.min_tilt_cosine, Range{0.01, 0.99});
  visit("best.card.refinement.systematic_px", card.refinement.systematic_px, Range{1e-4, 100});
  visit("best.card.coarse_blur_px", card.coarse_blur_px, Range{0.1, 50});
  visit("best.card.medium_blur_px", card.medium_blur_px, Range{0.1, 50});
  visit("best.card.finest_blur_px", card.finest_blur_px, Range{0.1, 50});
  visit("best.card.coarse_iterations", card.coarse_iterations, Range{0, 100});
  visit("best.card.medium_iterations", card.medium_iterations, Range{0, 100});
  visit("best.card.fine_iterations", card.fine_iterations, Range{0, 100});
  visit("best.card.max_correlation_lag", card.max_correlation_lag, Range{0, 2});
  visit("best.card.max_mirror_lag", card.max_mirror_lag, Range{0, 2});
  visit("best.card.max_medium_lag", card.max_medium_lag, Range{0, 2});
  visit("best.card.min_stage_samples", card.min_stage_samples, Range{0, 1e6});
  visit("best.card.max_samples", card.max_samples, Range{100, 1e7});
  visit("best.card.min_correlation", card.min_correlation, Range{0, 1});
  visit("best.card.min_visible_share", card.min_visible_share, Range{0, 1});
}

template <class Params, class Visit>
void visit_tracking_parameters(Params& best, Visit&& visit) {
  auto& tracking = best.tracking;
  using Range = ParameterRange;
  visit("best.tracking.corners.cell_px", tracking.corners.cell_px, Range{8, 8192});
  visit("best.tracking.corners.candidates_per_bucket", tracking.corners.candidates_per_bucket, Range{1, 255});
  visit("best.tracking.corners.corners_per_bucket", tracking.corners.corners_per_bucket, Range{1, 255});
  visit("best.tracking.corners.min_response", tracking.corners.min_response, Range{0, 1e6});
  visit("best.tracking.corners.min_share_of_best", tracking.corners.min_share_of_best, Range{0, 1});
  visit("best.tracking.corners.label_margin_px", tracking.corners.label_margin_px, Range{0, 256});
  visit("best.tracking.corners.burnt_level", tracking.corners.burnt_level, Range{1, 255});
  visit("best.tracking.alignment.max_shifts", tracking.alignment.max_shifts, Range{1, 1000});
  visit("best.tracking.alignment.max_affine_steps", tracking.alignment.max_affine_steps, Range{0, 1000});
  visit("best.tracking.alignment.converged_px", tracking.alignment.converged_px, Range{0, 10});
  visit("best.tracking.alignment.max_shift_px", tracking.alignment.max_shift_px, Range{0.01, 100});
  visit("best.tracking.alignment.max_affine_change", tracking.alignment.max_affine_change, Range{0, 2});
  visit("best.tracking.alignment.affine_sigma", tracking.alignment.affine_sigma, Range{1e-3, 100});
  visit("best.tracking.alignment.grey_sigma", tracking.alignment.grey_sigma, Range{1e-3, 255});
  visit("best.tracking.correction.turn_sigma_deg", tracking.correction.turn_sigma_deg, Range{1e-3, 90});
  visit("best.tracking.correction.shift_sigma_mm", tracking.correction.shift_sigma_mm, Range{1e-3, 1000});
  visit("best.tracking.correction.coarsest_scale_px", tracking.correction.coarsest_scale_px,
        Range{0.01, 1000});
  visit("best.tracking.correction.finest_scale_px", tracking.correction.finest_scale_px, Range{0.01, 1000});
  visit("best.tracking.correction.max_iterations", tracking.correction.max_iterations, Range{0, 100});
  visit("best.tracking.max_corners", tracking.max_corners, Range{1, 20000});
  visit("best.tracking.min_height_mm", tracking.min_height_mm, Range{-200, 0});
  visit("best.tracking.max_height_mm", tracking.max_height_mm, Range{1, 400});
  visit("best.tracking.band_height_mm", tracking.band_height_mm, Range{1, 1000});
  visit("best.tracking.first_look_cells", tracking.first_look_cells, Range{1, 16});
  visit("best.tracking.first_look_margin_px", tracking.first_look_margin_px, Range{0, 200});
  visit("best.tracking.first_look_correlation", tracking.first_look_correlation, Range{-1, 1});
  visit("best.tracking.margin_px", tracking.margin_px, Range{0, 200});
  visit("best.tracking.table_margin_px", tracking.table_margin_px, Range{0, 200});
  visit("best.tracking.min_correlation", tracking.min_correlation, Range{-1, 1});
  visit("best.tracking.min_table_correlation", tracking.min_table_correlation, Range{-1, 1});
  visit("best.tracking.min_lead", tracking.min_lead, Range{0, 2});
  visit("best.tracking.min_aligned_correlation", tracking.min_aligned_correlation, Range{-1, 1});
  visit("best.tracking.max_sigma_px", tracking.max_sigma_px, Range{0, 100});
  visit("best.tracking.max_return_px", tracking.max_return_px, Range{0, 100});
  visit("best.tracking.sure_sigma_px", tracking.sure_sigma_px, Range{0, 100});
  visit("best.tracking.max_epipolar_px", tracking.max_epipolar_px, Range{0.01, 1000});
  visit("best.tracking.pose_error_px", tracking.pose_error_px, Range{0, 100});
  visit("best.tracking.max_deviations", tracking.max_deviations, Range{0, 1000});
  visit("best.tracking.min_tracks", tracking.min_tracks, Range{0, 20000});
}

template <class Params, class Visit>
void visit_placement_parameters(Params& best, Visit&& visit) {
  auto& placement = best.joint.placement;
  using Range = ParameterRange;
  visit("best.joint.placement.point_sigma_px", placement.point_sigma_px, Range{0.01, 100});
  visit("best.joint.placement.min_robust_scale_px", placement.min_robust_scale_px, Range{0.01, 1000});
  visit("best.joint.placement.max_robust_scale_px", placement.max_robust_scale_px, Range{0.01, 1000});
  visit("best.joint.placement.first_robust_scale_px", placement.first_robust_scales_px[0], Range{0.01, 1000});
  visit("best.joint.placement.second_robust_scale_px", placement.first_robust_scales_px[1],
        Range{0.01, 1000});
  visit("best.joint.placement.third_robust_scale_px", placement.first_robust_scales_px[2], Range{0.01, 1000});
  visit("best.joint.placement.height_sigma_mm", placement.height_sigma_mm, Range{1e-3, 100});
  visit("best.joint.placement.size_sigma_mm", placement.size_sigma_mm, Range{1e-3, 100});
  visit("best.joint.placement.edge_drop_mm", placement.edge_drop_mm, Range{0, 50});
  visit("best.joint.placement.edge_drop_sigma_mm", placement.edge_drop_sigma_mm, Range{1e-3, 100});
  visit("best.joint.placement.max_view_points", placement.max_view_points, Range{8, 65536});
  visit("best.joint.placement.min_points", placement.min_points, Range{0, 65536});
  visit("best.joint.placement.min_view_points", placement.min_view_points, Range{0, 65536});
  visit("best.joint.placement.min_inlier_share", placement.min_inlier_share, Range{0, 1});
  visit("best.joint.placement.max_rms_px", placement.max_rms_px, Range{0, 1000});
  visit("best.joint.placement.iterations", placement.iterations, Range{0, 1000});
  visit("best.joint.placement.choice.size_tolerance_mm", placement.choice.size_tolerance_mm,
        Range{0.01, 1000});
  visit("best.joint.placement.choice.height_tolerance_mm", placement.choice.height_tolerance_mm,
        Range{0.01, 200});
}

template <class Params, class Visit>
void visit_joint_parameters(Params& best, Visit&& visit) {
  auto& joint = best.joint;
  using Range = ParameterRange;
  visit("best.membership.min_dish_border_share", best.membership.min_dish_border_share, Range{0, 1});
  visit("best.outline.block_sides", best.outline.block_sides, Range{1, 1000});
  visit("best.outline.search_step", best.outline.search_step, Range{1, 64});
  visit("best.joint.card_tilt_sigma_deg", joint.card_tilt_sigma_deg, Range{1e-3, 45});
  visit("best.joint.card_raised_sigma_mm", joint.card_raised_sigma_mm, Range{1e-3, 100});
  visit("best.joint.min_track_sigma_px", joint.min_track_sigma_px, Range{1e-3, 100});
  visit("best.joint.table_flatness_mm", joint.table_flatness_mm, Range{0, 100});
  visit("best.joint.robust_sigmas", joint.robust_sigmas, Range{0.1, 1000});
  visit("best.joint.max_noise_factor", joint.max_noise_factor, Range{1, 1000});
  visit("best.joint.use_tracks", joint.use_tracks);
  visit("best.joint.use_table", joint.use_table);
  visit("best.joint.use_rims", joint.use_rims);
  visit("best.joint.table.samples", joint.table.samples, Range{0, 10000});
  visit("best.joint.table.inlier_sigmas", joint.table.inlier_sigmas, Range{0.01, 1000});
  visit("best.joint.table.max_squared_deviation", joint.table.max_squared_deviation, Range{0, 1e6});
  visit("best.joint.table.reach_mm", joint.table.reach_mm, Range{1, 1e5});
  visit("best.joint.table.refits", joint.table.refits, Range{0, 100});
  visit("best.joint.table.min_points", joint.table.min_points, Range{0, 20000});
  visit("best.joint.table.max_side_share", joint.table.max_side_share, Range{0, 1000});
  visit("best.joint.table.seed", joint.table.seed, Range{0, 4294967295});
  visit("best.joint.iterations", joint.iterations, Range{0, 100});
  visit("best.joint.min_dish_tracks", joint.min_dish_tracks, Range{0, 20000});
  visit("best.joint.min_dish_inlier_share", joint.min_dish_inlier_share, Range{0, 1});
  visit_placement_parameters(best, visit);
}

}  // namespace traygauge
