#include "core/dish/rim_ellipse.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

using Vec5 = Eigen::Matrix<double, 5, 1>;
using Mat5 = Eigen::Matrix<double, 5, 5>;

// Two unit vectors that span the plane.
std::array<Vec3, 2> plane_axes(const Plane& plane) {
  const Vec3 helper = std::abs(plane.normal.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 first = plane.normal.cross(helper).normalized();
  return {first, plane.normal.cross(first)};
}

// Solves a symmetric positive definite system by Cholesky's method; false when it is singular.
bool solve_symmetric(Mat5 matrix, Vec5 right_side, Vec5& solution) {
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j <= i; ++j) {
      double rest = matrix(i, j);
      for (int k = 0; k < j; ++k) rest -= matrix(i, k) * matrix(j, k);
      if (i != j) {
        matrix(i, j) = rest / matrix(j, j);
      } else if (rest > 0.0) {
        matrix(i, i) = std::sqrt(rest);
      } else {
        return false;
      }
    }
    for (int k = 0; k < i; ++k) right_side[i] -= matrix(i, k) * right_side[k];
    right_side[i] /= matrix(i, i);
  }
  for (int i = 4; i >= 0; --i) {
    for (int k = i + 1; k < 5; ++k) right_side[i] -= matrix(k, i) * solution[k];
    solution[i] = right_side[i] / matrix(i, i);
  }
  return true;
}

}  // namespace

Result<RimEllipse> fit_rim_size(std::span<const Vec3> rim_points_mm, const Plane& rim) {
  if (rim_points_mm.size() < 5) return StatusCode::rim_not_found;
  const std::array<Vec3, 2> axes = plane_axes(rim);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : rim_points_mm) mean += point;
  mean /= static_cast<double>(rim_points_mm.size());
  double scale = 0.0;
  for (const Vec3& point : rim_points_mm) scale = std::max(scale, (point - mean).norm());
  if (!(scale > 0.0)) return StatusCode::rim_not_found;

  // A u² + B u v + C v² + D u + E v = 1, coordinates about the mean in units of the largest radius.
  Mat5 normal_matrix = Mat5::Zero();
  Vec5 right_side = Vec5::Zero();
  for (const Vec3& point : rim_points_mm) {
    const double u = axes[0].dot(point - mean) / scale;
    const double v = axes[1].dot(point - mean) / scale;
    const Vec5 row = (Vec5() << u * u, u * v, v * v, u, v).finished();
    for (int column = 0; column < 5; ++column) normal_matrix.col(column) += row[column] * row;
    right_side += row;
  }
  Vec5 conic = Vec5::Zero();
  if (!solve_symmetric(normal_matrix, right_side, conic)) return StatusCode::rim_not_found;
  Eigen::Matrix2d form;
  form << conic[0], 0.5 * conic[1], 0.5 * conic[1], conic[2];
  const Vec2 linear(conic[3], conic[4]);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(form);  // closed form; the iterative one refers to malloc at this size
  if (!(solver.eigenvalues()[0] > 0.0)) return StatusCode::rim_not_found;

  const Vec2 centre = -0.5 * solver.eigenvectors() *
                      (solver.eigenvectors().transpose() * linear).cwiseQuotient(solver.eigenvalues());
  const double level = 1.0 + centre.dot(form * centre);
  RimEllipse ellipse;
  ellipse.centre_mm = mean + scale * (centre.x() * axes[0] + centre.y() * axes[1]);
  for (int k = 0; k < 2; ++k) {  // eigenvalues ascend, so the long axis comes first
    const Vec2 direction = solver.eigenvectors().col(k);
    const auto i = static_cast<std::size_t>(k);
    ellipse.axes[i] = direction.x() * axes[0] + direction.y() * axes[1];
    ellipse.size_mm[i] = 2.0 * scale * std::sqrt(level / solver.eigenvalues()[k]);
  }
  return ellipse;
}

int choose_dish(std::span<const DishCandidate> candidates, const std::array<double, 2>& size_mm,
                double rim_height_mm, const DishChoiceParams& params) {
  const auto [measured_short, measured_long] = std::minmax(size_mm[0], size_mm[1]);
  int best = -1;
  double best_squares = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const DishCandidate& dish = candidates[i];
    const auto [dish_short, dish_long] = std::minmax(dish.outer_size_mm[0], dish.outer_size_mm[1]);
    const Vec3 deviation((measured_short - dish_short) / params.size_tolerance_mm,
                         (measured_long - dish_long) / params.size_tolerance_mm,
                         (rim_height_mm - dish.rim_height_mm) / params.height_tolerance_mm);
    if (!(deviation.cwiseAbs().maxCoeff() <= 1.0)) continue;
    if (best >= 0 && deviation.squaredNorm() >= best_squares) continue;
    best = static_cast<int>(i);
    best_squares = deviation.squaredNorm();
  }
  return best;
}

}  // namespace traygauge
