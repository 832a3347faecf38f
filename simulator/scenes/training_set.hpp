// Scenes to train the network on: what real trays have and the other sets lack.
#pragma once

#include <cstdint>
#include <vector>

#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

std::vector<SceneDescription> make_training_scenes(std::uint64_t seed);

}  // namespace traygauge
