// Light of the training set: what rooms have beside the lamps of the other sets.
#pragma once

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// The usual lamps; or a window that leaves hard shade, the sun, warm or cold lamps that the white balance
// does not mend. The views must be known.
void draw_training_light(SceneDescription& scene, Draws& draws);

// For some scenes little light. The views' exposures must be known.
void draw_dimness(SceneDescription& scene, Draws& draws);

}  // namespace traygauge
