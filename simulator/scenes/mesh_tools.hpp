// Making and measuring triangle meshes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "simulator/render/mesh.hpp"

namespace traygauge {

// Loops of equal length, each counter-clockwise seen from where the first looks, joined and closed by fans at
// both ends: a closed mesh.
TriangleMesh skin_of_loops(const std::vector<std::vector<Eigen::Vector3f>>& loops);

// One a vertex, weighted by area.
void add_smooth_normals(TriangleMesh& mesh);

void append(TriangleMesh& mesh, const TriangleMesh& more);
void transform(TriangleMesh& mesh, const Eigen::Isometry3d& placement);

// A box with its lower corner and its size.
TriangleMesh box_mesh(const Eigen::Vector3d& corner_mm, const Eigen::Vector3d& size_mm);

// Each edge belongs to two triangles, which run along it in opposite directions.
bool is_closed(const TriangleMesh& mesh);

// Of a closed mesh, by the divergence theorem; mm^3.
double enclosed_volume_mm3(const TriangleMesh& mesh);

}  // namespace traygauge
