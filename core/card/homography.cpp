#include "core/card/homography.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace traygauge {

namespace {

constexpr int kGaussNewtonSteps = 5;  // from the linear solution the third step is already below 1e-9 mm
constexpr double kNormalisedRadius = std::numbers::sqrt2;  // Hartley's: mean distance from the centroid

using Vec8 = Eigen::Matrix<double, 8, 1>;
using Mat8 = Eigen::Matrix<double, 8, 8>;

// A translation and a scaling to centroid 0 and mean distance √2.
struct Normalisation {
  Vec2 centroid = Vec2::Zero();
  double scale = 1.0;

  Vec2 operator*(const Vec2& point) const { return (point - centroid) * scale; }
  Mat3 matrix() const {
    Mat3 m = Mat3::Identity();
    m.topLeftCorner<2, 2>() *= scale;
    m.topRightCorner<2, 1>() = -scale * centroid;
    return m;
  }
};

// False when all points coincide.
bool normalise(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers,
               Vec2 CardTrack::*member, Normalisation& normalisation) {
  Vec2 sum = Vec2::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (inliers[i] == 0) continue;
    sum += tracks[i].*member;
    count += 1.0;
  }
  if (count < 4.0) return false;
  normalisation.centroid = sum / count;
  double distance = 0.0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (inliers[i] != 0) distance += (tracks[i].*member - normalisation.centroid).norm();
  }
  if (!(distance > 0.0)) return false;
  normalisation.scale = kNormalisedRadius * count / distance;
  return true;
}

// The projective basis: columns of the first three points, weighted so that they sum to the fourth.
bool basis_of(const std::array<Vec2, 4>& points, Mat3& basis) {
  basis << points[0].homogeneous(), points[1].homogeneous(), points[2].homogeneous();
  const double area = basis.determinant();
  if (area == 0.0) return false;
  const Vec3 weights = basis.inverse() * points[3].homogeneous();
  if ((weights.array() == 0.0).any()) return false;
  basis = basis * weights.asDiagonal();
  return true;
}

struct LinearEquations {
  Mat8 matrix = Mat8::Zero();
  Vec8 right = Vec8::Zero();

  void add(const Vec8& row, double value) {
    matrix.noalias() += row * row.transpose();
    right += value * row;
  }
};

// One linear row: (a · h) / (weight) = value, for the coordinate `row` (0: x, 1: y) of the pattern.
Vec8 coefficients(const Vec2& ray, double w, double coordinate, int row) {
  Vec8 a = Vec8::Zero();
  const int at = 3 * row;
  a.segment<3>(at) = ray.homogeneous() / w;
  a.tail<2>() = -coordinate / w * ray;
  return a;
}

bool solve(const LinearEquations& equations, Vec8& solution) {
  const Eigen::LDLT<Mat8> factors(equations.matrix);
  const double largest = factors.vectorD().maxCoeff();
  if (!(factors.vectorD().minCoeff() > kRounding * largest)) return false;
  solution = factors.solve(equations.right);
  return true;
}

Mat3 to_matrix(const Vec8& h) {
  Mat3 m;
  m << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1.0;
  return m;
}

}  // namespace

bool homography_from_four(const std::array<Vec2, 4>& rays, const std::array<Vec2, 4>& pattern,
                          Mat3& pattern_from_ray) {
  Mat3 from_rays;
  Mat3 from_pattern;
  if (!basis_of(rays, from_rays) || !basis_of(pattern, from_pattern)) return false;
  pattern_from_ray = from_pattern * from_rays.inverse();
  if (pattern_from_ray.row(2).dot(rays[0].homogeneous()) < 0.0) pattern_from_ray = -pattern_from_ray;
  return pattern_from_ray.allFinite();
}

// The last element is 1 in normalised coordinates: their origin, the rays' centroid, lies on the card and
// thus never on its horizon.
bool fit_homography(std::span<const CardTrack> tracks, std::span<const std::uint8_t> inliers, CardView view,
                    Mat3& pattern_from_ray) {
  Normalisation of_rays;
  Normalisation of_pattern;
  if (!normalise(tracks, inliers, view, of_rays) ||
      !normalise(tracks, inliers, &CardTrack::pattern_mm, of_pattern)) {
    return false;
  }
  Vec8 h = Vec8::Zero();
  for (int step = 0; step <= kGaussNewtonSteps; ++step) {
    LinearEquations equations;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (inliers[i] == 0) continue;
      const Vec2 ray = of_rays * (tracks[i].*view);
      const Vec2 target = of_pattern * tracks[i].pattern_mm;
      const double w = 1.0 + h.tail<2>().dot(ray);
      if (!(w > 0.0)) return false;
      for (int row = 0; row < 2; ++row) {
        if (step == 0) {  // algebraic distances
          equations.add(coefficients(ray, 1.0, target(row), row), target(row));
        } else {
          const double mapped = h.segment<3>(Eigen::Index{3} * row).dot(ray.homogeneous()) / w;
          equations.add(coefficients(ray, w, mapped, row), target(row) - mapped);
        }
      }
    }
    Vec8 update;
    if (!solve(equations, update)) return false;
    h += update;
  }
  pattern_from_ray = of_pattern.matrix().inverse() * to_matrix(h) * of_rays.matrix();
  return pattern_from_ray.allFinite();
}

}  // namespace traygauge
