#include "simulator/render/surface_map.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

constexpr float kStep_px = 4.0F;      // off the plane through the pixel's point
constexpr float kFoldCosine = 0.85F;  // between normals: 32°

}  // namespace

SurfaceMap::SurfaceMap(int width_px, int height_px) : width(width_px), height(height_px) {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  points_mm.resize(count, Eigen::Vector3f::Zero());
  normals.resize(count, Eigen::Vector3f::Zero());
  objects.resize(count);
  footprint_mm.resize(count);
  is_mixed.resize(count);
}

bool is_near_edge(const SurfaceMap& map, int reach_px, int x, int y) {
  const std::size_t here = map.index(x, y);
  for (int v = std::max(y - reach_px, 0); v <= std::min(y + reach_px, map.height - 1); ++v) {
    for (int u = std::max(x - reach_px, 0); u <= std::min(x + reach_px, map.width - 1); ++u) {
      const std::size_t there = map.index(u, v);
      if (map.objects[there] != map.objects[here]) return true;
      if (map.objects[here] == 0) continue;
      if (map.normals[there].dot(map.normals[here]) < kFoldCosine) return true;
      const float off_mm = map.normals[here].dot(map.points_mm[there] - map.points_mm[here]);
      if (std::abs(off_mm) > kStep_px * map.footprint_mm[here]) return true;
    }
  }
  return false;
}

}  // namespace traygauge
