// The parameters of the segmentation, by name and with the values that they may have.
#pragma once

#include "core/base/parameter_range.hpp"
#include "core/pipeline/segmenter_params.hpp"
#include "core/pipeline/surface_parameters.hpp"

namespace traygauge {

// As in best/sparse_parameters.hpp; `Params` is SegmenterParams, const or not.
template <class Params, class Visit>
void visit_card_search_parameters(Params& segmentation, Visit&& visit) {
  auto& card = segmentation.card;
  using Range = ParameterRange;
  visit("segmentation.card.search_px.first", card.search_px[0], Range{10'000, 4'000'000});
  visit("segmentation.card.search_px.second", card.search_px[1], Range{10'000, 4'000'000});
  constexpr std::array<const char*, kCardSearchScales> kScaleNames = {
      "segmentation.card.scales_px_per_mm.first", "segmentation.card.scales_px_per_mm.second",
      "segmentation.card.scales_px_per_mm.third", "segmentation.card.scales_px_per_mm.fourth",
      "segmentation.card.scales_px_per_mm.fifth", "segmentation.card.scales_px_per_mm.sixth"};
  for (std::size_t i = 0; i < kScaleNames.size(); ++i)
    visit(kScaleNames[i], card.scales_px_per_mm[i], Range{0.1, 20});
  visit("segmentation.card.max_pattern_corners", card.max_pattern_corners, Range{4, 4096});
  visit("segmentation.card.max_corners", card.max_corners, Range{16, 65535});
  visit("segmentation.card.first_corners", card.first_corners, Range{16, 65535});
  visit("segmentation.card.corners.cell_px", card.corners.cell_px, Range{8, 8192});
  visit("segmentation.card.corners.candidates_per_bucket", card.corners.candidates_per_bucket, Range{1, 255});
  visit("segmentation.card.corners.corners_per_bucket", card.corners.corners_per_bucket, Range{1, 255});
  visit("segmentation.card.corners.min_response", card.corners.min_response, Range{0, 1e6});
  visit("segmentation.card.corners.min_share_of_best", card.corners.min_share_of_best, Range{0, 1});
  visit("segmentation.card.corners.burnt_level", card.corners.burnt_level, Range{1, 255});
  visit("segmentation.card.max_distance", card.max_distance, Range{0, 256});
  visit("segmentation.card.max_half_distance", card.max_half_distance, Range{0, 128});
  visit("segmentation.card.max_distance_ratio", card.max_distance_ratio, Range{0, 1});
  visit("segmentation.card.same_place_mm", card.same_place_mm, Range{0, 100});
  visit("segmentation.card.near_px", card.near_px, Range{0, 1000});
  visit("segmentation.card.reach_share", card.reach_share, Range{0, 1});
  visit("segmentation.card.min_turn_cosine", card.min_turn_cosine, Range{-1, 1});
  visit("segmentation.card.max_scale_ratio", card.max_scale_ratio, Range{1, 100});
  visit("segmentation.card.max_seeds", card.max_seeds, Range{1, 10'000});
  visit("segmentation.card.max_tried", card.max_tried, Range{1, 100});
  visit("segmentation.card.min_agreeing", card.min_agreeing, Range{0, 65535});
  visit("segmentation.card.close_px_per_mm", card.close_px_per_mm, Range{0.1, 20});
  visit("segmentation.card.close_px", card.close_px, Range{10'000, 4'000'000});
  visit("segmentation.card.min_close_gain", card.min_close_gain, Range{1, 100});
  visit("segmentation.card.seed", card.seed, Range{0, 4294967295});
}

template <class Params, class Visit>
void visit_dish_search_parameters(Params& segmentation, Visit&& visit) {
  auto& dish = segmentation.dish;
  using Range = ParameterRange;
  visit("segmentation.dish.edges.max_px", dish.edges.max_px, Range{1000, 4'000'000});
  visit("segmentation.dish.edges.max_edges", dish.edges.max_edges, Range{16, 65536});
  visit("segmentation.dish.edges.min_difference", dish.edges.min_difference, Range{1, 510});
  visit("segmentation.dish.placement.point_sigma_px", dish.placement.point_sigma_px, Range{0.01, 100});
  visit("segmentation.dish.placement.edge_drop_mm", dish.placement.edge_drop_mm, Range{0, 50});
  visit("segmentation.dish.placement.min_points", dish.placement.min_points, Range{0, 65536});
  visit("segmentation.dish.cell_mm", dish.cell_mm, Range{0.5, 100});
  visit("segmentation.dish.cells", dish.cells, Range{8, 2048});
  visit("segmentation.dish.azimuths", dish.azimuths, Range{1, 360});
  visit("segmentation.dish.max_peaks", dish.max_peaks, Range{1, 16});
  // A band is one to 25 samples: with those on either side they fit into a profile across the rim.
  visit("segmentation.dish.band_mm", dish.band_mm, Range{0.5, 5});
  visit("segmentation.dish.sample_mm", dish.sample_mm, Range{0.2, 0.5});
  visit("segmentation.dish.vote_reach_mm", dish.vote_reach_mm, Range{1, 20});
  visit("segmentation.dish.shift_step_mm", dish.shift_step_mm, Range{0.5, 10});
  visit("segmentation.dish.azimuth_steps", dish.azimuth_steps, Range{1, 25});
  visit("segmentation.dish.same_place_mm", dish.same_place_mm, Range{0, 100});
  visit("segmentation.dish.sure_step", dish.sure_step, Range{0.1, 255});
  visit("segmentation.dish.edge_reach_mm", dish.edge_reach_mm, Range{0.5, 20});
  visit("segmentation.dish.scale_px", dish.scale_px, Range{0.01, 1000});
  visit("segmentation.dish.iterations", dish.iterations, Range{0, 200});
  visit("segmentation.dish.outline_points", dish.outline_points, Range{8, 1024});
  visit("segmentation.dish.min_step", dish.min_step, Range{0, 255});
  visit("segmentation.dish.min_step_over_noise", dish.min_step_over_noise, Range{0, 1000});
  visit("segmentation.dish.min_support", dish.min_support, Range{0, 1});
  visit("segmentation.dish.max_overlap", dish.max_overlap, Range{0, 1});
}

template <class Params, class Visit>
void visit_relief_parameters(Params& segmentation, Visit&& visit) {
  auto& relief = segmentation.relief;
  using Range = ParameterRange;
  visit_two_view_surface(relief.surface, PrefixedVisit("segmentation.relief.surface.", visit));
  visit("segmentation.relief.highest_mm", relief.highest_mm, Range{5, 400});
  visit("segmentation.relief.window_radius", relief.window_radius, Range{0, 32});
  visit("segmentation.relief.node_step", relief.node_step, Range{1, 64});
}

// `Params` is FoodFieldParams, const or not.
template <class Params, class Visit>
void visit_food_field_parameters(Params& field, Visit&& visit) {
  using Range = ParameterRange;
  visit("segmentation.food.field.fold", field.fold, Range{1, 3});  // a raster has three rows and more
  visit("segmentation.food.field.relief.min_height_mm", field.relief.min_height_mm, Range{0, 100});
  visit("segmentation.food.field.relief.full_bits", field.relief.full_bits, Range{0.1, 100});
  visit("segmentation.food.field.lift_weight", field.lift_weight, Range{0, 100});
  visit("segmentation.food.field.against_weight", field.against_weight, Range{0, 100});
  visit("segmentation.food.field.colour_weight", field.colour_weight, Range{0, 100});
  visit("segmentation.food.field.plain_share", field.plain_share, Range{0, 1});
  visit("segmentation.food.field.filled_mm", field.filled_mm, Range{0, 200});
  visit("segmentation.food.field.free_edge_mm", field.free_edge_mm, Range{-200, 200});
  visit("segmentation.food.field.prior", field.prior, Range{-100, 100});
  visit("segmentation.food.field.neutral_deviations", field.neutral_deviations, Range{0, 8});
  visit("segmentation.food.field.full_deviations", field.full_deviations, Range{8.5, 1000});
  visit("segmentation.food.field.most_colour", field.most_colour, Range{0, 100});
  visit("segmentation.food.field.shade_deviations", field.shade_deviations, Range{0, 100});
  visit("segmentation.food.field.tint_share", field.tint_share, Range{0, 2});
  visit("segmentation.food.field.standing_lift", field.standing_lift, Range{-10, 10});
  visit("segmentation.food.field.lit_luma", field.lit_luma, Range{0, 2});
  visit("segmentation.food.field.penumbra_luma", field.penumbra_luma, Range{0.01, 1});
  visit("segmentation.food.field.least_colour", field.least_colour, Range{-10, -0.001});
  visit("segmentation.food.field.neutral_texture", field.neutral_texture, Range{0, 5});
  visit("segmentation.food.field.full_texture", field.full_texture, Range{5.1, 1000});
  visit("segmentation.food.field.texture_reach", field.texture_reach, Range{0, kMaxMedianRadius});
  visit("segmentation.food.field.texture_weight", field.texture_weight, Range{0, 100});
  visit("segmentation.food.field.outline", field.outline, Range{0, 100});
  visit("segmentation.food.field.edge_contrast", field.edge_contrast, Range{0.1, 1000});
  visit("segmentation.food.field.least_outline", field.least_outline, Range{0, 1});
  visit("segmentation.food.field.sweeps", field.sweeps, Range{0, 1000});
}

template <class Params, class Visit>
void visit_food_parameters(Params& segmentation, Visit&& visit) {
  auto& food = segmentation.food;
  using Range = ParameterRange;
  visit("segmentation.food.raster.cell_mm", food.raster.cell_mm, Range{0.1, 20});
  visit("segmentation.food.raster.max_cells", food.raster.max_cells, Range{256, 1'000'000});
  visit("segmentation.food.raster.dark_level", food.raster.dark_level, Range{0, 255});
  visit("segmentation.food.glaze.min_share_sigma", food.glaze.min_share_sigma, Range{0.01, 255});
  visit("segmentation.food.glaze.texture_radius", food.glaze.texture_radius, Range{0, 16});
  visit("segmentation.food.glaze.min_flange_cells", food.glaze.min_flange_cells, Range{1, 1e6});
  visit("segmentation.food.geodesic.step_cost", food.geodesic.step_cost, Range{0, 255});
  visit("segmentation.food.geodesic.luma_weight", food.geodesic.luma_weight, Range{0, 1000});
  visit("segmentation.food.geodesic.share_weight", food.geodesic.share_weight, Range{0, 1000});
  visit("segmentation.food.split.block_mm", food.split.block_mm, Range{0.1, 100});
  visit("segmentation.food.split.max_blocks", food.split.max_blocks, Range{16, 65536});
  visit("segmentation.food.split.luma_weight", food.split.luma_weight, Range{0, 100});
  visit("segmentation.food.split.max_difference", food.split.max_difference, Range{0, 1000});
  visit("segmentation.food.split.mixed_deviation", food.split.mixed_deviation, Range{0.01, 1000});
  visit("segmentation.food.split.max_crest_ratio", food.split.max_crest_ratio, Range{1, 1000});
  visit("segmentation.food.split.min_crest_blocks", food.split.min_crest_blocks, Range{1, 4096});
  visit("segmentation.food.split.min_item_blocks", food.split.min_item_blocks, Range{1, 65536});
  visit("segmentation.food.split.min_core_blocks", food.split.min_core_blocks, Range{1, 65536});
  visit("segmentation.food.split.min_told_blocks", food.split.min_told_blocks, Range{1, 65536});
  visit("segmentation.food.split.likeness.constant", food.split.likeness.constant, Range{-1000, 1000});
  visit("segmentation.food.split.likeness.spread", food.split.likeness.spread, Range{-1000, 0});
  visit("segmentation.food.split.likeness.texture", food.split.likeness.texture, Range{-1000, 0});
  visit("segmentation.food.split.likeness.share", food.split.likeness.share, Range{0, 1000});
  visit("segmentation.food.split.likeness.valley", food.split.likeness.valley, Range{0, 1000});
  visit("segmentation.food.split.likeness.most_valley", food.split.likeness.most_valley, Range{0, 10});
  visit("segmentation.food.split.likeness.colours", food.split.likeness.colours, Range{-1000, 0});
  visit("segmentation.food.split.likeness.upon", food.split.likeness.upon, Range{-1000, 0});
  visit("segmentation.food.split.likeness.least_step", food.split.likeness.least_step, Range{0, 0.4});
  visit("segmentation.food.split.likeness.full_step", food.split.likeness.full_step, Range{0.41, 10});
  visit("segmentation.food.split.likeness.least_enclosed", food.split.likeness.least_enclosed, Range{0, 0.6});
  visit("segmentation.food.split.likeness.full_enclosed", food.split.likeness.full_enclosed, Range{0.61, 1});
  visit("segmentation.food.split.likeness.neck", food.split.likeness.neck, Range{0, 1000});
  visit("segmentation.food.split.likeness.least_flank", food.split.likeness.least_flank, Range{0.5, 1.25});
  visit("segmentation.food.split.likeness.full_flank", food.split.likeness.full_flank, Range{1.26, 10});
  visit("segmentation.food.split.likeness.least_edge", food.split.likeness.least_edge, Range{0, 0.81});
  visit("segmentation.food.split.likeness.full_edge", food.split.likeness.full_edge, Range{0.82, 10});
  visit("segmentation.food.split.likeness.least_flank_share", food.split.likeness.least_flank_share,
        Range{0, 0.3});
  visit("segmentation.food.split.likeness.full_flank_share", food.split.likeness.full_flank_share,
        Range{0.31, 1});
  visit("segmentation.food.split.likeness.doubtful_blocks", food.split.likeness.doubtful_blocks,
        Range{1, 65536});
  visit("segmentation.food.split.likeness.doubtful_crest_ratio", food.split.likeness.doubtful_crest_ratio,
        Range{1, 1000});
  visit("segmentation.food.assignment.fold", food.assignment.fold, Range{2, 8});
  visit("segmentation.food.assignment.window_mm", food.assignment.window_mm, Range{0, 50});
  visit("segmentation.food.assignment.nearness", food.assignment.nearness, Range{0, 1000});
  visit("segmentation.food.assignment.rounds", food.assignment.rounds, Range{0, 100});
  visit_food_field_parameters(food.field, visit);
  visit("segmentation.food.band_mm", food.band_mm, Range{0, 20});
  visit("segmentation.food.smoothing_mm", food.smoothing_mm, Range{0, 20});
  visit("segmentation.food.opening_mm", food.opening_mm, Range{0, 20});
  visit("segmentation.food.min_item_mm2", food.min_item_mm2, Range{0, 1e6});
  visit("segmentation.food.min_hole_mm2", food.min_hole_mm2, Range{0, 1e6});
}

template <class Params, class Visit>
void visit_segmentation_parameters(Params& segmentation, Visit&& visit) {
  using Range = ParameterRange;
  visit_card_search_parameters(segmentation, visit);
  visit_dish_search_parameters(segmentation, visit);
  visit_relief_parameters(segmentation, visit);
  visit_food_parameters(segmentation, visit);
  visit("segmentation.items", segmentation.items, Range{0, 198});
  visit("segmentation.weakest_border", segmentation.weakest_border, Range{0.01, 1});
  visit("segmentation.border_step", segmentation.border_step, Range{0.1, 0.99});
  visit("segmentation.likeness_step", segmentation.likeness_step, Range{0.01, 100});
  visit("segmentation.most_likeness", segmentation.most_likeness, Range{0, 1000});
  visit("segmentation.flange_begin_mm", segmentation.flange_begin_mm, Range{0, 100});
  visit("segmentation.flange_depth_mm", segmentation.flange_depth_mm, Range{0, 200});
  visit("segmentation.min_flange_mm", segmentation.min_flange_mm, Range{0, 100});
  visit("segmentation.food_heights_mm.low", segmentation.food_heights_mm[0], Range{0, 200});
  visit("segmentation.food_heights_mm.high", segmentation.food_heights_mm[1], Range{0, 200});
  visit("segmentation.min_confirmed_share", segmentation.min_confirmed_share, Range{0, 1});
  visit("segmentation.max_alignments", segmentation.max_alignments, Range{1, 100});
  visit("segmentation.doubtful_likeness", segmentation.doubtful_likeness, Range{-100, 0});
  visit("segmentation.sure_card_correlation", segmentation.sure_card_correlation, Range{0, 1});
  visit("segmentation.sure_correlation", segmentation.sure_correlation, Range{0, 1});
}

}  // namespace traygauge
