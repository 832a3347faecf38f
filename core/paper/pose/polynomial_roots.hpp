// Real roots of one polynomial of degree ten or less.
#pragma once

#include <array>

namespace traygauge::paper {

inline constexpr int kPolynomialDegree = 10;
using PolynomialCoefficients = std::array<double, kPolynomialDegree + 1>;  // [k] belongs to z^k

// Writes the real roots, ascending within |z| <= 1, then those beyond, and returns their number. A double
// root may be found twice or not at all. Bounded: no root takes more than a fixed number of evaluations.
int find_real_roots(const PolynomialCoefficients& coefficients, std::array<double, kPolynomialDegree>& roots);

}  // namespace traygauge::paper
