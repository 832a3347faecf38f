#include "simulator/scenes/training_light.hpp"

#include <array>
#include <cmath>
#include <span>

#include "simulator/scenes/scene_parts.hpp"

namespace traygauge {
namespace {

// A window, or with a small size the sun, low over the table.
struct SideLight {
  double away_mm = 0.0;
  double middle_mm = 0.0;
  double width_mm = 0.0;
  double height_mm = 0.0;
};

Lamp side_lamp(Draws& draws, const SideLight& light, const Eigen::Vector3d& radiance) {
  const double direction = draws.angle_rad();
  const Eigen::Vector3d out(std::cos(direction), std::sin(direction), 0.0);
  const Eigen::Vector3d across(-out.y(), out.x(), 0.0);
  return {light.away_mm * out + Eigen::Vector3d(0.0, 0.0, light.middle_mm), light.width_mm * across,
          Eigen::Vector3d(0.0, 0.0, light.height_mm), radiance};
}

}  // namespace

void draw_training_light(SceneDescription& scene, Draws& draws) {
  const Eigen::Vector3d warm(1.35, 0.96, 0.58);
  const Eigen::Vector3d cold(0.82, 1.0, 1.22);
  const Eigen::Vector3d day(0.95, 1.0, 1.06);
  switch (draws.whole(0, 5)) {
    case 0: {
      const SideLight window{draws.between(900.0, 1500.0), draws.between(500.0, 900.0),
                             draws.between(700.0, 1400.0), draws.between(700.0, 1200.0)};
      scene.lamps.push_back(side_lamp(draws, window, 9.0 * day));
      set_room(scene, day, draws.between(0.05, 0.14), 0.85);
      break;
    }
    case 1: {
      const SideLight sun{draws.between(1500.0, 2200.0), draws.between(1000.0, 2600.0), 160.0, 160.0};
      scene.lamps.push_back(side_lamp(draws, sun, 400.0 * Eigen::Vector3d(1.08, 1.0, 0.88)));
      set_room(scene, day, draws.between(0.1, 0.3), 0.85);
      break;
    }
    case 2: {
      const Eigen::Vector3d colour = draws.chance(0.5) ? warm : cold;
      const double height_mm = draws.between(700.0, 1800.0);
      const double side_mm = draws.between(120.0, 700.0);
      scene.lamps.push_back({{draws.between(-500.0, 500.0), draws.between(-500.0, 500.0), height_mm},
                             {side_mm, 0.0, 0.0},
                             {0.0, side_mm, 0.0},
                             20.0 * colour});
      const double room_fraction = draws.between(0.08, 0.25);
      set_room(scene, colour, room_fraction, draws.between(0.2, 0.9));
      break;
    }
    default:
      draw_lamps(scene, draws);
      break;
  }
}

void draw_dimness(SceneDescription& scene, Draws& draws) {
  if (!draws.chance(0.25)) return;
  // Little light: fewer electrons, and a picture that is darker than it should be.
  scene.photography.full_well_electrons *= draws.between(0.06, 0.3);
  const double exposure = draws.between(0.45, 0.9);
  for (Photograph& view : scene.views) view.exposure *= exposure;
}

}  // namespace traygauge
