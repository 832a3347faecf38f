// A proof body on its dish: mesh, print and exact volume.
#pragma once

#include "simulator/scenes/dish_shell.hpp"
#include "simulator/scenes/laid_food.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// `food.body` names it; its length runs along the food's x. Throws std::invalid_argument for a body that does
// not exist, or does not stand on the dish's flat bottom.
ServedFood serve_body(const LaidFood& food, const SceneDescription& scene, const DishShell& shell);

}  // namespace traygauge
