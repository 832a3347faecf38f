#include "firmware/config/parameters.hpp"

#include <charconv>
#include <cmath>
#include <span>
#include <variant>

#include "firmware/base/exit_status.hpp"

namespace traygauge {
namespace {

// An enumeration's value with the names of all its values, in their order.
struct Choice {
  std::uint8_t* value = nullptr;
  std::vector<std::string> names;
};
using Reference = std::variant<int*, double*, float*, bool*, Choice>;

struct Parameter {
  std::string name;
  Reference reference;
};

template <class Enum>
Choice choice(Enum& value, std::vector<std::string> names) {
  static_assert(sizeof(Enum) == sizeof(std::uint8_t));
  return {reinterpret_cast<std::uint8_t*>(&value), std::move(names)};
}

std::vector<Parameter> sparse_parameters(Configuration& c) {
  return {
      {"view.matching_dish_px", &c.view.matching_dish_px},
      {"view.feature_dish_px", &c.view.feature_dish_px},
      {"view.card_px_per_mm", &c.view.card_px_per_mm},
      {"view.max_card_enlargement", &c.view.max_card_enlargement},
      {"view.max_card_rotation_deg", &c.view.max_card_rotation_deg},
      {"limits.max_keypoints", &c.limits.max_keypoints},
      {"limits.max_card_keypoints", &c.limits.max_card_keypoints},
      {"limits.max_pattern_keypoints", &c.limits.max_pattern_keypoints},
      {"limits.max_feature_px", &c.limits.max_feature_px},
      {"surf.octaves", &c.surf.octaves},
      {"surf.first_step_px", &c.surf.first_step_px},
      {"surf.min_response", &c.surf.min_response},
      {"surf.upright", &c.surf.upright},
      {"matcher.top_ranking", &c.matcher.top_ranking},
      {"matcher.distinctiveness_ratio", &c.matcher.distinctiveness_ratio},
      {"matcher.distance_cutoff", &c.matcher.distance_cutoff},
      {"matcher.search", choice(c.matcher.search, {"exhaustive", "kd_tree"})},
      {"pose.threshold", choice(c.pose.threshold, {"fixed", "a_contrario", "false_discovery"})},
      {"pose.fixed_threshold_px", &c.pose.fixed_threshold_px},
      {"pose.max_noise_share", &c.pose.max_noise_share},
      {"pose.noise_sample", &c.pose.noise_sample},
      {"pose.min_inliers", &c.pose.min_inliers},
      {"pose.min_inlier_rate", &c.pose.min_inlier_rate},
      {"pose.local_optimisation", &c.pose.local_optimisation},
      {"pose.local_samples", &c.pose.local_samples},
      {"pose.local_iterations", &c.pose.local_iterations},
      {"pose.max_restarts", &c.pose.max_restarts},
      {"pose.min_iterations", &c.pose.min_iterations},
      {"pose.max_iterations", &c.pose.max_iterations},
      {"pose.refine", &c.pose.refine},
      {"pose.try_planar_twin", &c.pose.try_planar_twin},
      {"pose.robust_scale", &c.pose.robust_scale},
      {"card.tracks", choice(c.card_search.tracks, {"triangle", "one_side"})},
      {"card.model", choice(c.card_search.detection.model, {"homography", "absolute_pose"})},
      {"card.inlier_share", &c.card_search.detection.inlier_share},
      {"card.min_tracks", &c.card_search.detection.min_tracks},
      {"card.scale", choice(c.card_search.scale.method, {"half_sample_mode", "median", "card_motion"})},
      {"card.min_distance_share", &c.card_search.scale.min_distance_share},
      {"card.plane", choice(c.card_search.plane.source, {"sparse_points", "absolute_pose"})},
      {"card.plane_inlier_mm", &c.card_search.plane.inlier_mm},
      {"geometry.reference_is_steeper", &c.geometry.reference_is_steeper},
  };
}

std::vector<Parameter> dense_parameters(Configuration& c) {
  return {
      {"disparity_range.share", &c.disparity_range.share},
      {"disparity_range.enlargement_px", &c.disparity_range.enlargement_px},
      {"stereo.cost", choice(c.stereo.cost, {"census", "sad", "zncc"})},
      {"stereo.census_radius_px", &c.stereo.census_radius_px},
      {"stereo.window_radius_px", &c.stereo.window_radius_px},
      {"stereo.levels", &c.stereo.levels},
      {"stereo.band_px", &c.stereo.band_px},
      {"stereo.smoothness", &c.stereo.smoothness},
      {"stereo.smoothness_deviation", &c.stereo.smoothness_deviation},
      {"stereo.variance_radius_px", &c.stereo.variance_radius_px},
      {"stereo.median_radius_px", &c.stereo.median_radius_px},
      {"stereo.subpixel", &c.stereo.subpixel},
      {"mesh.points", &c.mesh.points},
      {"mesh.sampling", choice(c.mesh.sampling, {"pixel", "cell_mean"})},
      {"rim.source", choice(c.rim.source, {"dense", "contour", "both"})},
      {"rim.inset_px", &c.rim.inset_px},
      {"rim.min_crossing_sine", &c.rim.min_crossing_sine},
      {"rim.plane_threshold_mm", &c.rim.plane.threshold_mm},
      {"dish.surface", choice(c.dish.surface, {"rim_and_card", "card_alone"})},
      {"dish.height", choice(c.dish.height, {"rim_points_over_card_plane", "card_points_under_rim_plane"})},
      {"dish.mode_halvings", &c.dish.mode.halvings},
      {"volume.folded", choice(c.volume.folded, {"subtracted", "added"})},
  };
}

std::vector<Parameter> all_parameters(Configuration& configuration) {
  std::vector<Parameter> parameters = sparse_parameters(configuration);
  for (Parameter& parameter : dense_parameters(configuration)) parameters.push_back(std::move(parameter));
  return parameters;
}

template <class Number>
bool parse(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, number);
  return problem == std::errc() && stop == end;
}

bool assign(int* target, const std::string& text) {
  return parse(text, *target);
}
bool assign(double* target, const std::string& text) {
  return parse(text, *target) && std::isfinite(*target);
}
bool assign(float* target, const std::string& text) {
  return parse(text, *target) && std::isfinite(*target);
}
bool assign(bool* target, const std::string& text) {
  *target = text == "true";
  return text == "true" || text == "false";
}
bool assign(const Choice& target, const std::string& text) {
  for (std::size_t i = 0; i < target.names.size(); ++i) {
    if (target.names[i] != text) continue;
    *target.value = static_cast<std::uint8_t>(i);
    return true;
  }
  return false;
}

std::string shown(const int* value) {
  return std::to_string(*value);
}
std::string shown(const double* value) {
  return std::to_string(*value);
}
std::string shown(const float* value) {
  return std::to_string(*value);
}
std::string shown(const bool* value) {
  return *value ? "true" : "false";
}
std::string shown(const Choice& value) {
  return value.names[*value.value];
}

}  // namespace

void set_parameter(Configuration& configuration, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  const std::string text = equals == std::string::npos ? std::string() : assignment.substr(equals + 1);
  for (const Parameter& parameter : all_parameters(configuration)) {
    if (parameter.name != name) continue;
    if (std::visit([&](const auto& target) { return assign(target, text); }, parameter.reference)) return;
    throw UsageError("--set " + name + ": \"" + text + "\" is not a value of this parameter");
  }
  throw UsageError("--set: no parameter \"" + name + "\"; see traygauge evaluate --parameters");
}

std::vector<std::string> list_parameters(const Configuration& configuration) {
  Configuration copy = configuration;
  std::vector<std::string> lines;
  for (const Parameter& parameter : all_parameters(copy)) {
    lines.push_back(parameter.name + "=" +
                    std::visit([](const auto& target) { return shown(target); }, parameter.reference));
  }
  return lines;
}

}  // namespace traygauge
