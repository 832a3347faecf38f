// The essential matrices that a sample of matches allows, as a linear space.
#pragma once

#include <array>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"

namespace traygauge::paper {

// An orthonormal basis of the 3x3 matrices that solve x2ᵀ E x1 = 0: exactly for five matches (Nistér [27],
// III), for more the four right singular vectors with the smallest singular values. At least five matches.
void span_epipolar_null_space(std::span<const RayMatch> matches, std::array<Mat3, 4>& basis);

}  // namespace traygauge::paper
