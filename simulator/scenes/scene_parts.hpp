// Parts that the sets' scenes are made of, drawn from a seed.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/food_kinds.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

enum class DishStyle : std::uint8_t { dinner, soup, oval, bowl, dessert_bowl };

// Sizes and profile to tenths of a mm; the rim is the profile's second point, the bottom its last.
void scale_dish(DishDescription& dish, double scale);

// All lengths of the usual dish of this style times `scale`, glazed.
LaidDish draw_dish(Draws& draws, DishStyle style, double scale, int label);

// Level ground for one food, so wide and so high; `label` is what the truth calls it.
LaidDish ground_under_food(double width_mm, double height_mm, int label);

// Lays out foods of these kinds on the flat of a dish, side by side; label order is theirs.
void draw_foods(SceneDescription& scene, Draws& draws, int dish, DishStyle style, double scale,
                std::span<const FoodKind* const> kinds);

// Fills a dish with a liquid, to a share of the height between its bottom and its rim.
void draw_filling(SceneDescription& scene, Draws& draws, int dish, const FoodKind& kind,
                  double level_fraction);

// Ceiling panels, tubes, a window or a pendant lamp; a phone's white balance mends most of their colour.
void draw_lamps(SceneDescription& scene, Draws& draws);

// The room's light, which the lamps leave and which is their colour: `fraction` of theirs at the table. And
// the white balance of all views, which mends `mended` of the colour: from 0 to 1.
void set_room(SceneDescription& scene, const Eigen::Vector3d& colour, double fraction, double mended);

// A phone's camera.
void draw_camera(SceneDescription& scene, Draws& draws, double focal_px);

// What each view's exposure, white balance and focus miss beside the first's.
void draw_exposures(SceneDescription& scene, Draws& draws);

// The card beside the only dish.
void draw_card(SceneDescription& scene, Draws& draws);

}  // namespace traygauge
