// Meshes of simple solids.
#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>

#include "simulator/render/mesh.hpp"

namespace traygauge {

// About z, through (radius, height) from the middle of the upper side over the outside to the middle of the
// underside.
TriangleMesh turned_mesh(std::span<const std::pair<double, double>> section_mm);

// A cone with round ends, or with equal radii a capsule.
TriangleMesh limb_mesh(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm, double from_radius_mm,
                       double to_radius_mm);

// About the origin; an ellipsoid with exponents 2, a box with rounded edges above 5.
TriangleMesh superquadric_mesh(const Eigen::Vector3d& semi_mm, double side_exponent, double height_exponent);

}  // namespace traygauge
