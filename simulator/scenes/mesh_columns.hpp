// Volumes of meshes by vertical columns.
#pragma once

#include <functional>

#include "simulator/render/mesh.hpp"

namespace traygauge {

struct Columns {
  double volume_mm3 = 0.0;
  double area_mm2 = 0.0;
};

// Between the upper surface of a mesh and the ground, what the mesh overhangs included.
Columns columns_above(const TriangleMesh& mesh, double step_mm,
                      const std::function<double(double x_mm, double y_mm)>& ground_mm);

// What a closed mesh encloses, as the lengths of columns inside of it.
double solid_columns_mm3(const TriangleMesh& mesh, double step_mm);

// What lies inside two closed meshes at once.
double shared_columns_mm3(const TriangleMesh& first, const TriangleMesh& second, double step_mm);

}  // namespace traygauge
