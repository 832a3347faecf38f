// Trays with food that lies on no dish.
#pragma once

#include <cstdint>
#include <vector>

#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// beside-8: a plate with a meal, and one or two pieces beside it; on every third tray it is one, on a napkin.
std::vector<SceneDescription> make_beside(std::uint64_t seed);

}  // namespace traygauge
