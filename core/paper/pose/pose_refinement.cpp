#include "core/paper/pose/pose_refinement.hpp"

#include <cmath>
#include <numbers>

#include "core/paper/pose/epipolar.hpp"

namespace traygauge::paper {
namespace {

constexpr double kMinNormal = 1e-12;  // of an epipolar line; a point that near the epipole has no direction
constexpr double kHalfOfSquares =
    0.5 * std::numbers::sqrt2;  // a distance is the root of the mean of its two squares

// Two unit vectors that complete unit t to an orthogonal frame.
Eigen::Matrix<double, 3, 2> tangents(const Vec3& t) {
  Eigen::Index smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  const Vec3 first = t.cross(Vec3::Unit(smallest)).normalized();
  Eigen::Matrix<double, 3, 2> basis;
  basis << first, t.cross(first);
  return basis;
}

struct Linearisation {
  Mat3 essential;
  Vec3 translation;
  Mat3 rotation;
  Eigen::Matrix<double, 3, 2> sphere;
};

// Derivative of uᵀ E v, u and v fixed. With y = R v: by w it is y × (u × t), by t it is y × u.
EpipolarProblem::Equations::Vector bilinear_derivative(const Linearisation& at, const Vec3& u,
                                                       const Vec3& v) {
  const Vec3 y = at.rotation * v;
  EpipolarProblem::Equations::Vector d;
  d.head<3>() = y.cross(u.cross(at.translation));
  d.tail<2>() = at.sphere.transpose() * y.cross(u);
  return d;
}

}  // namespace

double EpipolarProblem::linearise(const Pose& pose, Equations& equations) const {
  const Linearisation at{essential_matrix(pose), pose.translation, pose.rotation, tangents(pose.translation)};
  double cost = 0.0;
  for (const std::uint32_t i : indices_) {
    const RayMatch match = matches_[i];
    const Vec3 x1 = match.first.homogeneous();
    const Vec3 x2 = match.second.homogeneous();
    const Vec3 line2 = at.essential * x1;
    const Vec3 line1 = at.essential.transpose() * x2;
    const double normal2 = line2.head<2>().norm();
    const double normal1 = line1.head<2>().norm();
    if (normal1 < kMinNormal || normal2 < kMinNormal) continue;
    const double constraint = x2.dot(line2);
    const double scale2 = kHalfOfSquares * focal_px_ / normal2;
    const double scale1 = kHalfOfSquares * focal_px_ / normal1;
    const double residual2 = constraint * scale2;
    const double residual1 = constraint * scale1;
    const double squared = residual1 * residual1 + residual2 * residual2;
    const double shrink = 1.0 / (1.0 + squared * inverse_squared_scale_);
    cost += squared * shrink;
    // d(c / n) = (dc − c n·dn / n²) / n, and both terms are bilinear in the rays.
    const Vec3 unit2(line2.x(), line2.y(), 0.0);
    const Vec3 unit1(line1.x(), line1.y(), 0.0);
    const Vec3 u = scale2 * (x2 - constraint / (normal2 * normal2) * unit2);
    const Vec3 v = scale1 * (x1 - constraint / (normal1 * normal1) * unit1);
    const double weight = shrink * shrink;
    equations.add(residual2, bilinear_derivative(at, u, x1), weight);
    equations.add(residual1, bilinear_derivative(at, x2, v), weight);
  }
  return cost;
}

double EpipolarProblem::cost(const Pose& pose) const {
  const Mat3 essential = essential_matrix(pose);
  double cost = 0.0;
  for (const std::uint32_t i : indices_) {
    const double distance = symmetric_epipolar_distance_px(essential, matches_[i], focal_px_);
    const double squared = distance * distance;
    cost += squared / (1.0 + squared * inverse_squared_scale_);
  }
  return cost;
}

Pose EpipolarProblem::moved(const Pose& pose, const Equations::Vector& step) {
  const Mat3 turn = rotation_about(step.head<3>());
  const Vec3 translation = pose.translation + tangents(pose.translation) * step.tail<2>();
  return {Eigen::Quaterniond(turn * pose.rotation).normalized().toRotationMatrix(), translation.normalized()};
}

}  // namespace traygauge::paper
