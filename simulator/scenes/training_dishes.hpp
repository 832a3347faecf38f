// Dishes of the training set: small ones, bowls of glass and metal, and glazes of every colour.
#pragma once

#include <cstdint>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/food_kinds.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

enum class SmallDish : std::uint8_t { side_plate, dessert_plate, salad_bowl, ramekin };

// White, or of a colour, a pattern, a painted rim.
void draw_training_glaze(Draws& draws, Glaze& glaze);

// Usual lengths times a drawn scale, glazed; a salad bowl is of clear glass or metal at times.
LaidDish draw_small_dish(Draws& draws, SmallDish kind, int label);

// One food in the middle of a dish, as large as it is usual or as has room.
void draw_middle_food(SceneDescription& scene, Draws& draws, int dish, const FoodKind& kind);

}  // namespace traygauge
