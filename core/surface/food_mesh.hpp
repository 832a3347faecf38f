// The food surface: a fixed number of grid points, triangulated in the picture (paper III-C-1).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

struct FoodMeshParams {
  int points = 4096;  // 2^12 (paper, Table IV)
};

struct MeshPoint {
  Vec3 position_mm = Vec3::Zero();  // in the first camera
  std::uint8_t label = 0;
};

struct MeshTriangle {
  std::array<std::int32_t, 3> corners{};
  std::uint8_t label = 0;
};

// Views into the workspace.
struct FoodMesh {
  std::span<const MeshPoint> points;
  std::span<const MeshTriangle> triangles;
  double spacing_px = 0.0;
};

}  // namespace traygauge
