#include "simulator/render/indirect_filter.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

constexpr float kReach = 2.0F;         // of the window, in sigmas
constexpr float kNormalPower = 32.0F;  // half the weight at 12° between normals
constexpr float kPlaneShare = 2.0F;    // a point this many pixels off the plane has 1/e of the weight

}  // namespace

Eigen::Vector3f smooth_at(const SurfaceMap& map, const std::vector<Eigen::Vector3f>& light, float sigma_px,
                          int x, int y) {
  const std::size_t here = map.index(x, y);
  if (map.objects[here] == 0 || !(sigma_px > 0.0F)) return light[here];
  const int reach = static_cast<int>(std::ceil(kReach * sigma_px));
  const float per_plane_mm = 1.0F / (kPlaneShare * map.footprint_mm[here]);
  const float per_square_px = -0.5F / (sigma_px * sigma_px);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0.0F;
  for (int v = std::max(y - reach, 0); v <= std::min(y + reach, map.height - 1); ++v) {
    for (int u = std::max(x - reach, 0); u <= std::min(x + reach, map.width - 1); ++u) {
      const std::size_t there = map.index(u, v);
      if (map.objects[there] != map.objects[here]) continue;
      const float turn = map.normals[here].dot(map.normals[there]);
      if (turn <= 0.5F) continue;
      const float off = std::abs(map.normals[here].dot(map.points_mm[there] - map.points_mm[here]));
      const auto square = static_cast<float>((u - x) * (u - x) + (v - y) * (v - y));
      const float weight =
          std::exp(per_square_px * square + kNormalPower * (turn - 1.0F) - per_plane_mm * off);
      sum += weight * light[there];
      weights += weight;
    }
  }
  return sum / weights;
}

}  // namespace traygauge
