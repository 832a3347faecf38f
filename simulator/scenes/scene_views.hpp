// Where the camera stands for the pictures of a scene.
#pragma once

#include <cstddef>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// Whether the rims of all dishes and the whole card are in the picture, some pixels from its border.
bool is_all_in_picture(const SceneDescription& scene, const Photograph& view);

// Whether a dish stands between the camera and a part of the card.
bool is_card_hidden(const SceneDescription& scene, const Photograph& view);

struct ViewLimits {
  double nearest_mm = 400.0;
  double farthest_mm = 600.0;
  double steepest_tilt_deg = 40.0;
  double least_angle_deg = 5.0;  // between any two views
  double largest_angle_deg = 35.0;
};

// `count` views by hand, and every pair of them. Throws std::invalid_argument when none are found.
void draw_views(SceneDescription& scene, Draws& draws, int count, const ViewLimits& limits);

// A first view and further ones by an arm that turns about the world's x through the dish's middle, in steps
// of 5°; pairs of the first with each. Throws as draw_views() does.
void draw_arm_views(SceneDescription& scene, Draws& draws, double distance_mm, int steps);

// One view, and one of the tray turned and shifted under the still camera.
void draw_moved_views(SceneDescription& scene, Draws& draws, const ViewLimits& limits);

// To a first and a second view: the second again with the card, the first dish with its food, or a food on
// that dish slipped by each of several lengths, card and dish away from each other; pairs of the first with
// each.
void add_slips(SceneDescription& scene, Draws& draws);

// Keeps the first `count` pairs, and of the views those up to the last that these need.
void keep_first_pairs(SceneDescription& scene, std::size_t count);

}  // namespace traygauge
