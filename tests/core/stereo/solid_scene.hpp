// Solids of known volume on a dish, ray cast into surface grids.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/dish/dish_profile.hpp"
#include "tests/core/stereo/true_grid.hpp"

namespace traygauge::test {

// Half-space z <= top(x, y) inside its footprint, or an ellipsoid; table frame, mm.
struct Solid {
  std::string name;
  int label = 0;
  std::function<double(const Vec2&)> top;  // a height field's; far below the table where it is not
  Vec3 centre_mm = Vec3::Zero();           // an ellipsoid's
  Vec3 semi_axes_mm = Vec3::Zero();        // the first two turned by `turn_rad` about z
  double turn_rad = 0.0;
  bool is_liquid = false;

  bool is_ellipsoid() const { return semi_axes_mm.x() > 0.0; }
};

struct SolidScene {
  InnerSurface dish;
  std::vector<Solid> solids;
  double max_height_mm = 80.0;  // of everything

  struct Hit {
    Vec3 point_mm = Vec3::Zero();
    int label = 0;
  };
  // The first surface on a ray that comes from above.
  Hit cast(const Vec3& origin_mm, const Vec3& direction) const;
  // Upper surface: what an orthographic view from straight above sees.
  Hit top(const Vec2& at_mm) const;

  double column_ml(int label, double step_mm = 0.25) const;
  double closed_ml(int label) const;
};

struct SceneCamera {
  double distance_mm = 500.0;
  double tilt_deg = 15.0;
  double azimuth_deg = 0.0;
};

struct SceneNoise {
  double depth_mm = 0.0;
  double label_px = 0.0;
  int correlation_px = 1;
  std::uint32_t seed = 1;
};

// About `dish_samples` of the grid's samples lie on the dish.
TrueGrid cast_grid(const SolidScene& scene, const SceneCamera& camera, const SceneNoise& noise = {},
                   double dish_samples = kWorkingDishPixels);

inline constexpr double kNothingMm = -1000.0;

Solid box(int label, const Vec2& centre, const Vec2& half, double turn_rad, double top_mm);
Solid cylinder(int label, const Vec2& centre, double radius, double top_mm);
Solid cone(int label, const Vec2& centre, double radius, double base_mm, double height);
Solid cap(int label, const Vec2& centre, double radius, double base_mm, double height);
// A slice of a round cake, tip first.
Solid wedge(int label, const Vec2& tip, double radius, double angle_rad, double turn_rad, double top_mm);
// Spheres side by side, filled up below: what a height field makes of them.
Solid ball_columns(int label, const std::vector<Vec2>& centres, double radius, double base_mm);
// A heap with a bumpy surface.
Solid heap(int label, const Vec2& centre, const Vec2& radius, double base_mm, double height, double bump_mm,
           double wavelength_mm, std::uint32_t seed);
Solid ellipsoid(int label, const Vec3& centre, const Vec3& semi_axes, double turn_rad);
Solid liquid(int label, const InnerSurface& dish, double level_mm);

InnerSurface dinner_plate();
InnerSurface soup_bowl();
InnerSurface oval_plate();

}  // namespace traygauge::test
