// Room on a tray.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// What a thing covers on the tray: a rectangle or an ellipse.
struct Footprint {
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
  double rotation_deg = 0.0;
  double half_x_mm = 0.0;
  double half_y_mm = 0.0;
  bool is_ellipse = false;
};

// Closer than `gap_mm` to each other, or one in the other.
bool overlap(const Footprint& a, const Footprint& b, double gap_mm);

// On its flat floor.
bool is_on_tray(const Footprint& footprint, const Tray& tray);

// Gives the tray's dishes, card and, where there is room, napkin and cutlery their places. Throws
// std::invalid_argument when dishes and card do not fit.
void lay_out_tray(SceneDescription& scene, Draws& draws);

}  // namespace traygauge
