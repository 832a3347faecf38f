// Room for the card and for things beside dishes.
#pragma once

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// Without a tray: the card beside the dishes. Throws std::invalid_argument when it finds no place.
void lay_card_beside(SceneDescription& scene, Draws& draws);

// `count` things of any kind, each on the tray or beside it, where there is room; a hand comes in from
// outside.
void lay_things(SceneDescription& scene, Draws& draws, int count);

}  // namespace traygauge
