#include "simulator/scenes/scene_series.hpp"

#include "simulator/scenes/scene_parts.hpp"

namespace traygauge {

std::string numbered(const char* letter, std::size_t number) {
  return std::string(letter) + (number < 10 ? "0" : "") + std::to_string(number);
}

SceneDescription empty_scene(const std::string& name, Draws& draws) {
  SceneDescription scene;
  scene.name = name;
  scene.seed = draws.seed();
  return scene;
}

void draw_table(SceneDescription& scene, Draws& draws, std::span<const SurfaceKind> kinds) {
  scene.table = {draws.pick(kinds), draws.between(0.0, 180.0), draws.seed()};
}

void draw_tray(SceneDescription& scene, Draws& draws) {
  constexpr std::array kTops = {SurfaceKind::plastic, SurfaceKind::wood, SurfaceKind::laminate};
  scene.tray = Tray{{530.0, 380.0}, draws.pick(std::span<const SurfaceKind>(kTops)), draws.seed()};
  draw_table(scene, draws, kTables);
}

void finish(SceneDescription& scene, Draws& draws) {
  draw_lamps(scene, draws);
  draw_exposures(scene, draws);
  draws.shuffle(std::span<LaidFood>(scene.foods));  // labels tell nothing
}

}  // namespace traygauge
