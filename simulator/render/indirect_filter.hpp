// Smooths noisy light over like surfaces.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "simulator/render/surface_map.hpp"

namespace traygauge {

// Smooths the rows from `first_row` to before `end_row` of a picture's light. Refers to both; what a row
// needs is laid out by component, so that eight neighbours are weighed together.
class LightSmoother {
 public:
  LightSmoother(const SurfaceMap& map, std::span<const Eigen::Vector3f> light, float radius_px, int first_row,
                int end_row);

  // Mean of the light around a pixel of these rows, weighed by a bell of radius_px, by how little the surface
  // turns, and by how near the other point lies to the plane through this one; of one object only. A mixed
  // pixel is left as it is.
  Eigen::Vector3f at(int x, int y) const;

 private:
  static constexpr int kLanes = 8;
  static constexpr std::size_t kPlanes = 10;
  enum Plane : std::uint8_t { surface, normal_x, normal_y, normal_z, x_mm, y_mm, z_mm, red, green, blue };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - top_) * stride_ + static_cast<std::size_t>(x);
  }
  void fill_row(int y);

  const SurfaceMap& map_;
  std::span<const Eigen::Vector3f> light_;
  int reach_;
  int top_;     // first row that counts for these
  int bottom_;  // the one after the last
  std::size_t stride_;
  std::array<std::vector<float>, kPlanes> planes_;
  std::size_t bell_stride_;
  std::vector<float> bells_;  // by row and column, from -reach_ on; 0 beyond
};

}  // namespace traygauge
