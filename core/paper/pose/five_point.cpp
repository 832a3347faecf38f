#include "core/paper/pose/five_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/paper/pose/epipolar_null_space.hpp"
#include "core/paper/pose/polynomial_roots.hpp"

namespace traygauge::paper {
namespace {

// E = x X + y Y + z Z + W with X, Y, Z, W the basis of the null space. Orders of monomials:
//   linear     x, y, z, 1
//   quadratic  x², xy, xz, x, y², yz, y, z², z, 1
//   cubic      x³, y³, x²y, xy², x²z, x², y²z, y², xyz, xy, | xz², xz, x, yz², yz, y, z³, z², z, 1
// The cubic order is Nistér's: eliminating the first ten leaves polynomials in z times x, y and 1.
using Linear = std::array<double, 4>;
using Quadratic = std::array<double, 10>;
using Cubic = std::array<double, 20>;
using LinearMatrix = std::array<std::array<Linear, 3>, 3>;
using Constraints = std::array<Cubic, 10>;

constexpr std::size_t kEliminated = 10;
constexpr std::size_t kFirstUsedRow = 4;  // rows of x²z, x², y²z, y², xyz, xy: Nistér's e to j
constexpr double kMinPivotRatio = 1e-4;   // a smaller pivot costs more digits than the roots can spare
constexpr int kMaxBases = 3;
constexpr double kTurnCosine = 0.6;
constexpr double kTurnSine = 0.8;
constexpr int kMaxPolishSteps = 10;  // one or two do, unless the elimination was badly conditioned
// Of the ten constraints, on a matrix of norm 1.
constexpr double kRoundingResidual = 1e-13;
constexpr double kMaxConstraintResidual = 1e-10;
constexpr double kSameSolution = 1e-8;  // squared distance of two polished roots that are one

void add_product(const Linear& a, const Linear& b, double sign, Quadratic& q) {
  q[0] += sign * (a[0] * b[0]);
  q[1] += sign * (a[0] * b[1] + a[1] * b[0]);
  q[2] += sign * (a[0] * b[2] + a[2] * b[0]);
  q[3] += sign * (a[0] * b[3] + a[3] * b[0]);
  q[4] += sign * (a[1] * b[1]);
  q[5] += sign * (a[1] * b[2] + a[2] * b[1]);
  q[6] += sign * (a[1] * b[3] + a[3] * b[1]);
  q[7] += sign * (a[2] * b[2]);
  q[8] += sign * (a[2] * b[3] + a[3] * b[2]);
  q[9] += sign * (a[3] * b[3]);
}

void add_product(const Quadratic& q, const Linear& a, Cubic& c) {
  c[0] += q[0] * a[0];
  c[1] += q[4] * a[1];
  c[2] += q[0] * a[1] + q[1] * a[0];
  c[3] += q[1] * a[1] + q[4] * a[0];
  c[4] += q[0] * a[2] + q[2] * a[0];
  c[5] += q[0] * a[3] + q[3] * a[0];
  c[6] += q[4] * a[2] + q[5] * a[1];
  c[7] += q[4] * a[3] + q[6] * a[1];
  c[8] += q[1] * a[2] + q[2] * a[1] + q[5] * a[0];
  c[9] += q[1] * a[3] + q[3] * a[1] + q[6] * a[0];
  c[10] += q[2] * a[2] + q[7] * a[0];
  c[11] += q[2] * a[3] + q[3] * a[2] + q[8] * a[0];
  c[12] += q[3] * a[3] + q[9] * a[0];
  c[13] += q[5] * a[2] + q[7] * a[1];
  c[14] += q[5] * a[3] + q[6] * a[2] + q[8] * a[1];
  c[15] += q[6] * a[3] + q[9] * a[1];
  c[16] += q[7] * a[2];
  c[17] += q[7] * a[3] + q[8] * a[2];
  c[18] += q[8] * a[3] + q[9] * a[2];
  c[19] += q[9] * a[3];
}

// det E = 0: expansion along the first row.
void add_determinant(const LinearMatrix& e, Cubic& row) {
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t k = (j + 1) % 3;
    const std::size_t l = (j + 2) % 3;
    Quadratic minor{};
    add_product(e[1][k], e[2][l], 1.0, minor);
    add_product(e[1][l], e[2][k], -1.0, minor);
    add_product(minor, e[0][j], row);
  }
}

// (E Eᵀ − ½ trace(E Eᵀ) I) E = 0: nine equations.
void add_trace_constraints(const LinearMatrix& e, Constraints& rows) {
  std::array<std::array<Quadratic, 3>, 3> gram{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) add_product(e[i][k], e[j][k], 1.0, gram[i][j]);
      gram[j][i] = gram[i][j];
    }
  }
  for (std::size_t m = 0; m < gram[0][0].size(); ++m) {
    const double half_trace = 0.5 * (gram[0][0][m] + gram[1][1][m] + gram[2][2][m]);
    for (std::size_t i = 0; i < 3; ++i) gram[i][i][m] -= half_trace;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) add_product(gram[i][k], e[k][j], rows[1 + 3 * i + j]);
    }
  }
}

Constraints cubic_constraints(const std::array<Mat3, 4>& basis) {
  LinearMatrix e;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 4; ++k) {
        e[i][j][k] = basis[k](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
  }
  Constraints rows{};
  add_determinant(e, rows[0]);
  add_trace_constraints(e, rows);
  return rows;
}

void subtract_row(const Cubic& source, double factor, std::size_t start, Cubic& target) {
  for (std::size_t c = start; c < source.size(); ++c) target[c] -= factor * source[c];
}

// Gauss-Jordan elimination with row pivoting; only the six rows that Nistér uses are fully reduced. False
// when the constraints are dependent, or nearly: the basis is then in a special position.
bool eliminate(Constraints& rows) {
  double largest_pivot = 0.0;
  for (std::size_t k = 0; k < kEliminated; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < kEliminated; ++r) {
      if (std::abs(rows[r][k]) > std::abs(rows[pivot][k])) pivot = r;
    }
    const double size = std::abs(rows[pivot][k]);
    largest_pivot = std::max(largest_pivot, size);
    if (!(size > kMinPivotRatio * largest_pivot)) return false;
    if (pivot != k) std::swap(rows[pivot], rows[k]);
    const double scale = 1.0 / rows[k][k];
    for (std::size_t c = k; c < rows[k].size(); ++c) rows[k][c] *= scale;
    for (std::size_t r = k + 1; r < kEliminated; ++r) subtract_row(rows[k], rows[r][k], k, rows[r]);
  }
  for (std::size_t k = kEliminated; k-- > kFirstUsedRow + 1;) {
    for (std::size_t r = kFirstUsedRow; r < k; ++r) subtract_row(rows[k], rows[r][k], k, rows[r]);
  }
  return true;
}

// Another orthonormal basis of the same space.
void turn_basis(std::array<Mat3, 4>& basis) {
  const std::array<Mat3, 4> old = basis;
  basis[0] = kTurnCosine * old[3] - kTurnSine * old[0];
  basis[3] = kTurnSine * old[3] + kTurnCosine * old[0];
  basis[1] = kTurnCosine * old[1] - kTurnSine * old[2];
  basis[2] = kTurnSine * old[1] + kTurnCosine * old[2];
}

// A row of B(z) [x y 1]ᵀ = 0; coefficient [k] belongs to z^k.
struct MatrixRow {
  std::array<double, 4> x;
  std::array<double, 4> y;
  std::array<double, 5> one;
};

// e − z f and its like: the monomials with x² and so on cancel (Nistér's k, l, m).
MatrixRow subtract_shifted(const Cubic& e, const Cubic& f) {
  MatrixRow row;
  row.x = {e[12], e[11] - f[12], e[10] - f[11], -f[10]};
  row.y = {e[15], e[14] - f[15], e[13] - f[14], -f[13]};
  row.one = {e[19], e[18] - f[19], e[17] - f[18], e[16] - f[17], -f[16]};
  return row;
}

template <std::size_t A, std::size_t B, std::size_t C>
void add_polynomial_product(const std::array<double, A>& a, const std::array<double, B>& b, double sign,
                            std::array<double, C>& product) {
  static_assert(C >= A + B - 1);
  for (std::size_t i = 0; i < A; ++i) {
    for (std::size_t j = 0; j < B; ++j) product[i + j] += sign * (a[i] * b[j]);
  }
}

// det B(z): Nistér's tenth-degree polynomial.
PolynomialCoefficients determinant(const std::array<MatrixRow, 3>& b) {
  PolynomialCoefficients n{};
  std::array<double, 8> minor_x{};
  add_polynomial_product(b[0].y, b[1].one, 1.0, minor_x);
  add_polynomial_product(b[1].y, b[0].one, -1.0, minor_x);
  add_polynomial_product(minor_x, b[2].x, 1.0, n);
  std::array<double, 8> minor_y{};
  add_polynomial_product(b[1].x, b[0].one, 1.0, minor_y);
  add_polynomial_product(b[0].x, b[1].one, -1.0, minor_y);
  add_polynomial_product(minor_y, b[2].y, 1.0, n);
  std::array<double, 7> minor_one{};
  add_polynomial_product(b[0].x, b[1].y, 1.0, minor_one);
  add_polynomial_product(b[1].x, b[0].y, -1.0, minor_one);
  add_polynomial_product(minor_one, b[2].one, 1.0, n);
  return n;
}

template <std::size_t N>
double horner(const std::array<double, N>& c, double z) {
  double value = c[N - 1];
  for (std::size_t k = N - 1; k-- > 0;) value = value * z + c[k];
  return value;
}

// (x, y, z) at a root z: the null vector of B(z) by the best conditioned cross product of two rows.
bool back_substitute(const std::array<MatrixRow, 3>& b, double z, Vec3& xyz) {
  std::array<Vec3, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] = Vec3(horner(b[i].x, z), horner(b[i].y, z), horner(b[i].one, z));
    rows[i] /= rows[i].cwiseAbs().maxCoeff();
  }
  Vec3 null_vector = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 cross = rows[i].cross(rows[(i + 1) % 3]);
    if (cross.squaredNorm() > null_vector.squaredNorm()) null_vector = cross;
  }
  xyz = Vec3(null_vector.x() / null_vector.z(), null_vector.y() / null_vector.z(), z);
  return xyz.allFinite();
}

// Value and derivatives by x, y, z of the cubic monomials.
using MonomialTable = std::array<std::array<double, 4>, 20>;
void evaluate_monomials(const Vec3& p, MonomialTable& m) {
  const double x = p.x();
  const double y = p.y();
  const double z = p.z();
  m = {{{x * x * x, 3 * x * x, 0, 0},
        {y * y * y, 0, 3 * y * y, 0},
        {x * x * y, 2 * x * y, x * x, 0},
        {x * y * y, y * y, 2 * x * y, 0},
        {x * x * z, 2 * x * z, 0, x * x},
        {x * x, 2 * x, 0, 0},
        {y * y * z, 0, 2 * y * z, y * y},
        {y * y, 0, 2 * y, 0},
        {x * y * z, y * z, x * z, x * y},
        {x * y, y, x, 0},
        {x * z * z, z * z, 0, 2 * x * z},
        {x * z, z, 0, x},
        {x, 1, 0, 0},
        {y * z * z, 0, z * z, 2 * y * z},
        {y * z, 0, z, y},
        {y, 0, 1, 0},
        {z * z * z, 0, 0, 3 * z * z},
        {z * z, 0, 0, 2 * z},
        {z, 0, 0, 1},
        {1, 0, 0, 0}}};
}

// Gauss-Newton on the ten constraints: takes back what the elimination lost. False when p is no root.
bool polish(const Constraints& constraints, Vec3& p) {
  MonomialTable monomials;
  for (int step = 0; step <= kMaxPolishSteps; ++step) {
    evaluate_monomials(p, monomials);
    Mat3 hessian = Mat3::Zero();
    Vec3 gradient = Vec3::Zero();
    double squared_residual = 0.0;
    for (const Cubic& row : constraints) {
      std::array<double, 4> sums{};
      for (std::size_t m = 0; m < row.size(); ++m) {
        for (std::size_t k = 0; k < 4; ++k) sums[k] += row[m] * monomials[m][k];
      }
      const Vec3 jacobian(sums[1], sums[2], sums[3]);
      hessian += jacobian * jacobian.transpose();
      gradient += sums[0] * jacobian;
      squared_residual += sums[0] * sums[0];
    }
    const double size = p.squaredNorm() + 1.0;  // squared norm of the unscaled matrix
    const double relative = squared_residual / (size * size * size);
    if (relative <= kRoundingResidual * kRoundingResidual) return true;
    if (step == kMaxPolishSteps) return relative <= kMaxConstraintResidual * kMaxConstraintResidual;
    p -= hessian.inverse() * gradient;
    if (!p.allFinite()) break;
  }
  return false;
}

}  // namespace

int solve_five_point(std::span<const RayMatch> matches, std::array<Mat3, kMaxEssentials>& essentials) {
  if (matches.size() < 5) return 0;
  std::array<Mat3, 4> basis;
  span_epipolar_null_space(matches, basis);
  Constraints constraints = cubic_constraints(basis);
  Constraints reduced = constraints;
  for (int attempt = 1; !eliminate(reduced); ++attempt) {
    if (attempt == kMaxBases) return 0;
    turn_basis(basis);
    reduced = constraints = cubic_constraints(basis);
  }
  const std::array<MatrixRow, 3> b = {subtract_shifted(reduced[4], reduced[5]),
                                      subtract_shifted(reduced[6], reduced[7]),
                                      subtract_shifted(reduced[8], reduced[9])};
  std::array<double, kPolynomialDegree> roots;
  const int root_count = find_real_roots(determinant(b), roots);
  std::array<Vec3, kMaxEssentials> solutions;
  std::size_t count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(root_count); ++i) {
    Vec3& p = solutions[count];
    if (!back_substitute(b, roots[i], p) || !polish(constraints, p)) continue;
    const bool is_new = std::none_of(
        solutions.begin(), solutions.begin() + static_cast<std::ptrdiff_t>(count), [&](const Vec3& other) {
          return (other - p).squaredNorm() <= kSameSolution * kSameSolution * (p.squaredNorm() + 1.0);
        });
    if (!is_new) continue;
    essentials[count] = (p.x() * basis[0] + p.y() * basis[1] + p.z() * basis[2] + basis[3]).normalized();
    ++count;
  }
  return static_cast<int>(count);
}

}  // namespace traygauge::paper
