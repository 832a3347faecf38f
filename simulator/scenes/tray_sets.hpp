// Scenes with several dishes on a tray.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/food_kinds.hpp"
#include "simulator/scenes/scene_description.hpp"
#include "simulator/scenes/scene_menu.hpp"

namespace traygauge {

// A plate with a meal, a bowl or plate with soup and, on some, a dessert; no views yet.
SceneDescription lay_tray(const std::string& name, Draws draws, bool has_dessert,
                          std::span<const FoodKind* const> meal, Menu& soups, Menu& desserts);

// The set trays-8, or moved-4: then each tray is moved under a still camera.
std::vector<SceneDescription> make_trays(std::uint64_t seed, const std::string& set, const char* letter,
                                         std::size_t count, bool is_moved);

// The set station-40.
std::vector<SceneDescription> make_station(std::uint64_t seed);

}  // namespace traygauge
