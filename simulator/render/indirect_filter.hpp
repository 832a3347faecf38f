// Smooths noisy light over like surfaces.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/render/surface_map.hpp"

namespace traygauge {

// Mean of `light` around a pixel, weighed by a bell of radius_px, by how little the surface turns, and by
// how near the other point lies to the plane through this one; of one object only. A mixed pixel is left as
// it is.
Eigen::Vector3f smooth_at(const SurfaceMap& map, const std::vector<Eigen::Vector3f>& light, float radius_px,
                          int x, int y);

}  // namespace traygauge
