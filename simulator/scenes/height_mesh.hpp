// A height field as a closed mesh on its dish.
#pragma once

#include <functional>

#include "simulator/render/mesh.hpp"
#include "simulator/scenes/height_field.hpp"

namespace traygauge {

// Height at a place in the dish's coordinates, mm.
using GroundHeight = std::function<double(double x_mm, double y_mm)>;

// What stands between the `base` that the heights count from (dish or level of a liquid) and the `dish`
// below.
struct FoodSolid {
  TriangleMesh mesh;             // upper side with smooth normals, walls, lower side on the dish
  double volume_mm3 = 0.0;       // between upper side and dish
  double above_plane_mm3 = 0.0;  // between upper side and a horizontal plane
  double footprint_mm2 = 0.0;
  double on_wall_mm2 = 0.0;    // of the footprint: where the dish is higher than the plane
  double max_height_mm = 0.0;  // above the dish
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();  // of the footprint
};

// `field` extended outward. The border of the footprint is where inside_mm passes 0 between nodes.
FoodSolid mesh_of_field(const HeightField& field, const GroundHeight& base, const GroundHeight& dish,
                        double plane_height_mm);

}  // namespace traygauge
