// What the scenes of all sets are begun and ended with.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "simulator/scenes/draws.hpp"
#include "simulator/scenes/scene_description.hpp"
#include "simulator/scenes/scene_views.hpp"

namespace traygauge {

inline constexpr double kPhoneFocalPx = 1400.0;  // 60 degrees across: the phones of the paper
inline constexpr double kWideFocalPx = 1225.0;   // 66 degrees: a whole tray from 60 cm
inline constexpr ViewLimits kTrayViews{500.0, 660.0, 26.0, 8.0, 25.0};
inline constexpr std::array kTables = {SurfaceKind::wood, SurfaceKind::laminate, SurfaceKind::cloth,
                                       SurfaceKind::plastic};

// The letter and two digits.
std::string numbered(const char* letter, std::size_t number);

SceneDescription empty_scene(const std::string& name, Draws& draws);

void draw_table(SceneDescription& scene, Draws& draws, std::span<const SurfaceKind> kinds);

// A tray on a table.
void draw_tray(SceneDescription& scene, Draws& draws);

// Light, and what the camera makes of it, once the views are known.
void finish(SceneDescription& scene, Draws& draws);

// One scene after the other, each with draws of its own: lay(i, name, draws) gives it with its views.
template <class Lay>
std::vector<SceneDescription> make_each(std::size_t count, const char* letter, const std::string& set,
                                        std::uint64_t seed, Lay lay) {
  std::vector<SceneDescription> scenes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = numbered(letter, i + 1);
    std::string stream = set;
    stream.append(" ").append(name);
    Draws draws(seed, stream);
    SceneDescription scene = lay(i, name, draws);
    finish(scene, draws);
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace traygauge
