#include "core/paper/pose/epipolar_null_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace traygauge::paper {
namespace {

constexpr std::size_t kEntries = 9;
constexpr std::size_t kFivePoints = 5;
constexpr std::size_t kBasis = 4;
constexpr int kMaxSweeps = 12;  // Jacobi converges quadratically: 9x9 takes six or seven
// Off-diagonal square sum, relative to the trace's square, below which rotations change nothing.
constexpr double kJacobiTolerance = 1e-30;

// A mirror of general direction that mixes the basis: a vector of the plain one may well be orthogonal to the
// true matrix (sideways motion without rotation; ten exact matches), and Nistér's w = 1 would lose that.
constexpr std::array<double, kBasis> kMixing = {0.31, -0.54, 0.43, 0.71};
constexpr double kMixingSquaredNorm = 0.31 * 0.31 + 0.54 * 0.54 + 0.43 * 0.43 + 0.71 * 0.71;

using Vec9 = std::array<double, kEntries>;
using Mat9 = std::array<Vec9, kEntries>;

// The match's row: E in row-major order.
Vec9 epipolar_row(const RayMatch& match) {
  const double x1 = match.first.x();
  const double y1 = match.first.y();
  const double x2 = match.second.x();
  const double y2 = match.second.y();
  return {x2 * x1, x2 * y1, x2, y2 * x1, y2 * y1, y2, x1, y1, 1.0};
}

Mat3 as_matrix(const Vec9& e) {
  Mat3 m;
  m << e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7], e[8];
  return m;
}

double dot_from(const Vec9& a, const Vec9& b, std::size_t start) {
  double sum = 0.0;
  for (std::size_t i = start; i < kEntries; ++i) sum += a[i] * b[i];
  return sum;
}

// target -= 2 v (v·target), v of unit length from `start` on.
void reflect(const Vec9& v, std::size_t start, Vec9& target) {
  const double twice = 2.0 * dot_from(v, target, start);
  for (std::size_t i = start; i < kEntries; ++i) target[i] -= twice * v[i];
}

// Householder reflections H0…H4 make the five rows triangular; the complement is H0…H4 e5…e8.
void complement_five_rows(std::span<const RayMatch> matches, std::array<Mat3, kBasis>& basis) {
  std::array<Vec9, kFivePoints> rows;
  for (std::size_t k = 0; k < kFivePoints; ++k) rows[k] = epipolar_row(matches[k]);
  std::array<Vec9, kFivePoints> mirrors{};
  for (std::size_t k = 0; k < kFivePoints; ++k) {
    const double length = std::sqrt(dot_from(rows[k], rows[k], k));
    for (std::size_t i = k; i < kEntries; ++i) mirrors[k][i] = rows[k][i];
    mirrors[k][k] += rows[k][k] < 0.0 ? -length : length;
    const double norm = std::sqrt(dot_from(mirrors[k], mirrors[k], k));
    const double scale = norm > 0.0 ? 1.0 / norm : 0.0;  // a repeated match: no reflection
    for (std::size_t i = k; i < kEntries; ++i) mirrors[k][i] *= scale;
    for (std::size_t j = k + 1; j < kFivePoints; ++j) reflect(mirrors[k], k, rows[j]);
  }
  for (std::size_t b = 0; b < kBasis; ++b) {
    Vec9 e{};
    e[kFivePoints + b] = 1.0;
    for (std::size_t k = kFivePoints; k-- > 0;) reflect(mirrors[k], k, e);
    basis[b] = as_matrix(e);
  }
}

// One Jacobi rotation that clears a[p][q]; eigenvectors are the rows of v.
void rotate(Mat9& a, Mat9& v, std::size_t p, std::size_t q) {
  if (a[p][q] == 0.0) return;
  const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
  const double t = (theta < 0.0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0);
  const double s = t * c;
  for (std::size_t i = 0; i < kEntries; ++i) {
    const double row_p = a[p][i];
    const double row_q = a[q][i];
    a[p][i] = c * row_p - s * row_q;
    a[q][i] = s * row_p + c * row_q;
  }
  for (std::size_t i = 0; i < kEntries; ++i) {
    const double column_p = a[i][p];
    const double column_q = a[i][q];
    a[i][p] = c * column_p - s * column_q;
    a[i][q] = s * column_p + c * column_q;
  }
  for (std::size_t i = 0; i < kEntries; ++i) {
    const double row_p = v[p][i];
    const double row_q = v[q][i];
    v[p][i] = c * row_p - s * row_q;
    v[q][i] = s * row_p + c * row_q;
  }
}

void diagonalise(Mat9& a, Mat9& v) {
  double trace = 0.0;
  for (std::size_t i = 0; i < kEntries; ++i) {
    v[i].fill(0.0);
    v[i][i] = 1.0;
    trace += a[i][i];
  }
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double off_diagonal = 0.0;
    for (std::size_t p = 0; p + 1 < kEntries; ++p) {
      for (std::size_t q = p + 1; q < kEntries; ++q) {
        off_diagonal += a[p][q] * a[p][q];
        rotate(a, v, p, q);
      }
    }
    if (off_diagonal <= kJacobiTolerance * trace * trace) return;
  }
}

// Eigenvectors of AᵀA with the four smallest eigenvalues.
void smallest_singular_vectors(std::span<const RayMatch> matches, std::array<Mat3, kBasis>& basis) {
  Mat9 gram{};
  for (const RayMatch& match : matches) {
    const Vec9 row = epipolar_row(match);
    for (std::size_t i = 0; i < kEntries; ++i) {
      for (std::size_t j = 0; j < kEntries; ++j) gram[i][j] += row[i] * row[j];
    }
  }
  Mat9 vectors;
  diagonalise(gram, vectors);
  std::array<std::size_t, kEntries> order{0, 1, 2, 3, 4, 5, 6, 7, 8};
  for (std::size_t b = 0; b < kBasis; ++b) {
    for (std::size_t i = b + 1; i < kEntries; ++i) {
      if (gram[order[i]][order[i]] < gram[order[b]][order[b]]) std::swap(order[i], order[b]);
    }
    basis[b] = as_matrix(vectors[order[b]]);
  }
}

void mix(std::array<Mat3, kBasis>& basis) {
  Mat3 along = Mat3::Zero();
  for (std::size_t b = 0; b < kBasis; ++b) along += (2.0 * kMixing[b] / kMixingSquaredNorm) * basis[b];
  for (std::size_t b = 0; b < kBasis; ++b) basis[b] -= kMixing[b] * along;
}

}  // namespace

void span_epipolar_null_space(std::span<const RayMatch> matches, std::array<Mat3, 4>& basis) {
  if (matches.size() == kFivePoints) {
    complement_five_rows(matches, basis);
  } else {
    smallest_singular_vectors(matches, basis);
  }
  mix(basis);
}

}  // namespace traygauge::paper
