// Food on its dish: mesh, look and exact volumes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulator/render/scene.hpp"
#include "simulator/scenes/dish_shell.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// In the world's frame; `check_volume_ml` is found another way than volume_ml.
struct ServedFood {
  SceneObject object;
  std::string name;
  bool is_scan = false;
  bool is_body = false;  // a proof body: its volume is that of the closed form
  bool is_filled = false;
  double fill_level_mm = 0.0;
  double volume_ml = 0.0;
  double check_volume_ml = 0.0;
  double above_bottom_plane_ml = 0.0;
  double column_volume_ml = 0.0;
  double footprint_cm2 = 0.0;
  double share_on_wall = 0.0;
  double max_height_mm = 0.0;
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();  // in the world
  int dish = 0;
};

// Throws std::invalid_argument where the two volumes contradict each other. `step_mm`: of the meshed grid.
void require_agreement(const ServedFood& food, double step_mm = SceneDescription().food_step_mm);

// All foods of one dish, in their order; where two want one place the earlier stands there. `first_label`: of
// the food that comes first in scene.foods. Throws InputError for a mesh that cannot be read,
// std::invalid_argument for a kind or a level that does not exist, a scanned food that reaches into another
// food, and volumes that contradict each other. `threads`, 0 for one a core, change nothing but the time.
std::vector<ServedFood> serve_foods(const SceneDescription& scene, int dish, const DishShell& shell,
                                    int first_label, int threads = 0);

}  // namespace traygauge
