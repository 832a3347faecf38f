// Essential matrices from five or more matches: D. Nistér, "An efficient solution to the five-point relative
// pose problem" (paper [27]).
#pragma once

#include <array>
#include <span>

#include "core/geometry/geometry.hpp"
#include "core/geometry/triangulation.hpp"

namespace traygauge::paper {

inline constexpr std::size_t kMaxEssentials = 10;

// Writes the essential matrices (Frobenius norm 1, sign free) that agree with all matches — five: exactly,
// more: within the space that fits them best — and returns their number, 0…10. Fewer than five matches give
// none. Points in special position (repeated, all on one line) give none or arbitrary ones.
int solve_five_point(std::span<const RayMatch> matches, std::array<Mat3, kMaxEssentials>& essentials);

}  // namespace traygauge::paper
