// Triangles, in mm.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace traygauge {

// Counter-clockwise seen from outside. `normals`, of unit length, one a vertex, shade a smooth surface; none:
// flat triangles.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace traygauge
