// Foods from scans, whose whole surface is known.
#pragma once

#include <functional>

#include "simulator/render/mesh.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

// In mm, turned, its middle above the origin, with smooth normals. Throws InputError: read_mesh's, a mesh
// that is not closed, or one that is inside out.
TriangleMesh load_scan(const ScannedFood& scan);

// Moves the mesh vertically until it touches the ground.
void set_down(TriangleMesh& mesh, const std::function<double(double x_mm, double y_mm)>& ground_mm);

}  // namespace traygauge
