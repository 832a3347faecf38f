// Smooths noisy light over like surfaces.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace traygauge {

// What lies at the centre of each pixel, row by row.
struct SurfaceMap {
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector3f> points_mm;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> objects;  // 0: nothing or several things, not to be smoothed
  std::vector<float> footprint_mm;     // of a pixel, across the ray

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

// Mean of `light` around a pixel, weighed by a bell of radius_px, by how little the surface turns, and by
// how near the other point lies to the plane through this one; of one object only.
Eigen::Vector3f smooth_at(const SurfaceMap& map, const std::vector<Eigen::Vector3f>& light, float radius_px,
                          int x, int y);

}  // namespace traygauge
