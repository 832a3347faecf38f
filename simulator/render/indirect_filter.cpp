#include "simulator/render/indirect_filter.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

constexpr float kTurnShare = 0.03F;  // 1 - cosine of 14° between normals: no weight beyond
constexpr float kPlaneShare = 4.0F;  // nor for a point this many pixels off the plane

// A bell without exp: 1 at 0, 0 from 1 on.
float bell(float square) {
  const float rest = std::max(1.0F - square, 0.0F);
  return rest * rest;
}

}  // namespace

Eigen::Vector3f smooth_at(const SurfaceMap& map, const std::vector<Eigen::Vector3f>& light, float radius_px,
                          int x, int y) {
  const std::size_t here = map.index(x, y);
  if (map.objects[here] == 0 || map.is_mixed[here] != 0 || !(radius_px > 0.0F)) return light[here];
  const int reach = static_cast<int>(std::ceil(radius_px));
  const float per_plane_mm = 1.0F / (kPlaneShare * map.footprint_mm[here]);
  const float per_square_px = 1.0F / (radius_px * radius_px);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0.0F;
  for (int v = std::max(y - reach, 0); v <= std::min(y + reach, map.height - 1); ++v) {
    for (int u = std::max(x - reach, 0); u <= std::min(x + reach, map.width - 1); ++u) {
      const float square = static_cast<float>((u - x) * (u - x) + (v - y) * (v - y)) * per_square_px;
      const std::size_t there = map.index(u, v);
      if (square >= 1.0F || map.objects[there] != map.objects[here] || map.is_mixed[there] != 0) continue;
      const float turn = (1.0F - map.normals[here].dot(map.normals[there])) / kTurnShare;
      const float off = per_plane_mm * map.normals[here].dot(map.points_mm[there] - map.points_mm[here]);
      const float weight = bell(square) * bell(turn * turn) * bell(off * off);
      sum += weight * light[there];
      weights += weight;
    }
  }
  return sum / weights;
}

}  // namespace traygauge
