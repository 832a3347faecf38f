#include "core/paper/pose/polynomial_roots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace traygauge::paper {
namespace {

// A bracket of length 2 bisected this often is below the resolution of a double; Newton needs about six.
constexpr int kMaxRootSteps = 64;
// A last step of Newton this long leaves an error of its square. The derivatives' roots only part the line.
constexpr double kLastStep = 1e-8;
constexpr double kLastStepOfDerivative = 1e-5;
constexpr double kInfiniteRootInverse = 1e-9;  // roots beyond 1e9 belong to a vanishing leading coefficient

using Roots = std::array<double, kPolynomialDegree>;

double evaluate(const double* c, int degree, double z) {
  double value = c[degree];
  for (int k = degree - 1; k >= 0; --k) value = value * z + c[k];
  return value;
}

double evaluate(const double* c, int degree, double z, double& slope) {
  double value = c[degree];
  slope = 0.0;
  for (int k = degree - 1; k >= 0; --k) {
    slope = slope * z + value;
    value = value * z + c[k];
  }
  return value;
}

// The root between low and high, where the signs differ: Newton's steps kept inside a shrinking bracket.
double bracketed_root(const double* c, int degree, double low, double high, bool low_is_negative,
                      double last_step) {
  double z = 0.5 * (low + high);
  for (int step = 0; step < kMaxRootSteps; ++step) {
    double slope = 0.0;
    const double value = evaluate(c, degree, z, slope);
    if (value == 0.0) return z;
    ((value < 0.0) == low_is_negative ? low : high) = z;
    const double newton = z - value / slope;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - z) <= last_step) return next;
    z = next;
  }
  return z;
}

// Roots in [-1, 1], ascending. The roots of each derivative part the line into pieces where the polynomial
// one degree higher is monotone, so that each sign change encloses exactly one root.
int roots_in_unit_interval(const PolynomialCoefficients& coefficients, Roots& roots) {
  std::array<PolynomialCoefficients, kPolynomialDegree> derivatives;  // [k]: the k-th, of degree ten minus k
  derivatives[0] = coefficients;
  for (std::size_t k = 1; k < derivatives.size(); ++k) {
    for (std::size_t i = 0; i + k < coefficients.size(); ++i) {
      derivatives[k][i] = static_cast<double>(i + 1) * derivatives[k - 1][i + 1];
    }
  }
  int count = 0;
  for (int degree = 1; degree <= kPolynomialDegree; ++degree) {
    const double* c = derivatives[static_cast<std::size_t>(kPolynomialDegree - degree)].data();
    const double last_step = degree < kPolynomialDegree ? kLastStepOfDerivative : kLastStep;
    Roots found;
    int found_count = 0;
    double low = -1.0;
    bool low_is_negative = evaluate(c, degree, low) < 0.0;
    for (int i = 0; i <= count; ++i) {
      const double high = i < count ? roots[static_cast<std::size_t>(i)] : 1.0;
      const bool high_is_negative = evaluate(c, degree, high) < 0.0;
      if (low_is_negative != high_is_negative && found_count < degree) {
        found[static_cast<std::size_t>(found_count++)] =
            bracketed_root(c, degree, low, high, low_is_negative, last_step);
      }
      low = high;
      low_is_negative = high_is_negative;
    }
    count = found_count;
    std::copy_n(found.begin(), count, roots.begin());
  }
  return count;
}

}  // namespace

int find_real_roots(const PolynomialCoefficients& coefficients, Roots& roots) {
  const int inner = roots_in_unit_interval(coefficients, roots);
  PolynomialCoefficients reversed;  // its roots are the inverses
  std::reverse_copy(coefficients.begin(), coefficients.end(), reversed.begin());
  Roots inverses;
  const int outer = roots_in_unit_interval(reversed, inverses);
  int count = inner;
  for (int i = 0; i < outer && count < kPolynomialDegree; ++i) {
    const double inverse = inverses[static_cast<std::size_t>(i)];
    if (std::abs(inverse) < kInfiniteRootInverse || std::abs(inverse) >= 1.0) continue;
    roots[static_cast<std::size_t>(count++)] = 1.0 / inverse;
  }
  return count;
}

}  // namespace traygauge::paper
