// The parameters of profile `paper` that its authors left open or compared, by name and with the values that
// they may have.
#pragma once

#include "core/base/parameter_range.hpp"
#include "core/paper/pipeline/configuration.hpp"
#include "core/paper/stereo/block_rows.hpp"
#include "core/paper/stereo/hierarchy.hpp"
#include "core/paper/stereo/smoothness.hpp"
#include "core/stereo/median.hpp"

namespace traygauge::paper {

// Each calls visit(name, field, ParameterRange) for a number, visit(name, field) for a switch and
// visit(name, field, ParameterChoices) for an enumeration. `Config` is Configuration, const or not.
template <class Config, class Visit>
void visit_paper_features(Config& c, Visit&& visit) {
  using Range = ParameterRange;
  visit("view.matching_dish_px", c.view.matching_dish_px, Range{1024, 1e7});
  visit("view.feature_dish_px", c.view.feature_dish_px, Range{1024, 1e8});
  visit("view.match_dish_only", c.view.match_dish_only);
  visit("view.card_px_per_mm", c.view.card_px_per_mm, Range{0.5, 50});
  visit("view.max_card_enlargement", c.view.max_card_enlargement, Range{0.1, 20});
  visit("view.max_card_rotation_deg", c.view.max_card_rotation_deg, Range{0, 180});
  visit("limits.max_keypoints", c.caps.max_keypoints, Range{16, 1 << 16});
  visit("limits.max_card_keypoints", c.caps.max_card_keypoints, Range{0, 1 << 16});
  visit("limits.max_pattern_keypoints", c.caps.max_pattern_keypoints, Range{16, 1 << 16});
  visit("limits.max_feature_px", c.caps.max_feature_px, Range{1024, 1 << 26});
  visit("surf.octaves", c.surf.octaves, Range{1, kMaxOctaves});
  visit("surf.first_step_px", c.surf.first_step_px, Range{1, 4});
  visit("surf.min_response", c.surf.min_response, Range{1e-9, 1});
  visit("matcher.top_ranking", c.matcher.top_ranking, Range{1, 2});
  visit("matcher.distinctiveness_ratio", c.matcher.distinctiveness_ratio, Range{1, 100});
  visit("matcher.distance_cutoff", c.matcher.distance_cutoff, Range{0, 1});
}

template <class Config, class Visit>
void visit_paper_pose(Config& c, Visit&& visit) {
  using Range = ParameterRange;
  using Choices = ParameterChoices;
  visit("pose.threshold", c.pose.threshold, Choices{{"fixed", "a_contrario", "false_discovery"}});
  visit("pose.fixed_threshold_px", c.pose.fixed_threshold_px, Range{0.01, 1000});
  visit("pose.max_noise_fraction", c.pose.max_noise_fraction, Range{1e-6, 0.999});
  visit("pose.noise_sample", c.pose.noise_sample, Range{1, 100'000});
  visit("pose.min_inliers", c.pose.min_inliers, Range{6, 1 << 16});
  visit("pose.min_inlier_rate", c.pose.min_inlier_rate, Range{0, 1});
  visit("pose.local_optimisation", c.pose.local_optimisation);
  visit("pose.local_samples", c.pose.local_samples, Range{5, 32});
  visit("pose.local_iterations", c.pose.local_iterations, Range{0, 100});
  visit("pose.max_restarts", c.pose.max_restarts, Range{0, 1000});
  visit("pose.min_iterations", c.pose.min_iterations, Range{1, 10'000});
  visit("pose.max_iterations", c.pose.max_iterations, Range{1, 10'000});
  visit("pose.refine", c.pose.refine);
  visit("pose.robust_scale", c.pose.robust_scale, Range{0.01, 1e6});
  auto& card = c.card_search;
  visit("card.model", card.detection.model, Choices{{"homography", "absolute_pose"}});
  visit("card.inlier_fraction", card.detection.inlier_fraction, Range{1e-4, 1});
  visit("card.min_tracks", card.detection.min_tracks, Range{4, 1 << 16});
  visit("card.min_distance_fraction", card.scale.min_distance_fraction, Range{0, 1});
  visit("card.plane_inlier_mm", card.plane.inlier_mm, Range{0.001, 1000});
}

template <class Config, class Visit>
void visit_paper_surface(Config& c, Visit&& visit) {
  using Range = ParameterRange;
  using Choices = ParameterChoices;
  visit("disparity_range.share", c.disparity_range.share, Range{0, 1});
  visit("disparity_range.enlargement_px", c.disparity_range.enlargement_px, Range{0, 1000});
  visit("stereo.cost", c.stereo.cost, Choices{{"census", "sad", "zncc"}});
  visit("stereo.census_radius_px", c.stereo.census_radius_px, Range{1, kMaxCensusRadius});
  visit("stereo.window_radius_px", c.stereo.window_radius_px, Range{0, kMaxWindowRadius});
  visit("stereo.levels", c.stereo.levels, Range{1, kMaxLevels});
  visit("stereo.band_px", c.stereo.band_px, Range{0, 1024});
  visit("stereo.smoothness", c.stereo.smoothness, Range{0, 1000});
  visit("stereo.smoothness_deviation", c.stereo.smoothness_deviation, Range{0.001, 1000});
  visit("stereo.variance_radius_px", c.stereo.variance_radius_px, Range{1, kMaxVarianceRadius});
  visit("stereo.median_radius_px", c.stereo.median_radius_px, Range{0, kMaxMedianRadius});
  visit("mesh.points", c.mesh.points, Range{16, 1 << 18});
  visit("rim.min_crossing_sine", c.rim.min_crossing_sine, Range{0, 1});
  visit("rim.plane_threshold_mm", c.rim.plane.threshold_mm, Range{0.001, 100});
  visit("dish.surface", c.dish.surface, Choices{{"rim_and_card", "card_alone"}});
  visit("dish.mode_halvings", c.dish.mode.halvings, Range{0, 64});
}

// All of them, in the order of the stages.
template <class Config, class Visit>
void visit_parameters(Config& configuration, Visit&& visit) {
  visit_paper_features(configuration, visit);
  visit_paper_pose(configuration, visit);
  visit_paper_surface(configuration, visit);
}

}  // namespace traygauge::paper
