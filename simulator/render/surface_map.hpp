// What a camera sees, before any light.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace traygauge {

// What lies at the centre of each pixel, row by row.
struct SurfaceMap {
  int width;
  int height;
  std::vector<Eigen::Vector3f> points_mm;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::uint32_t> objects;  // 0: nothing
  std::vector<float> footprint_mm;     // of a pixel, across the ray
  std::vector<std::uint8_t> is_mixed;  // 1: the pixel's rays meet several surfaces

  SurfaceMap(int width_px, int height_px);

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

// Whether within `reach_px` columns and rows of a pixel another object, a step or a fold is seen.
bool is_near_edge(const SurfaceMap& map, int reach_px, int x, int y);

}  // namespace traygauge
