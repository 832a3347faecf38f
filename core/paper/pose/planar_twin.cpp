#include "core/paper/pose/planar_twin.hpp"

#include <cmath>

#include "core/geometry/levenberg_marquardt.hpp"
#include "core/geometry/triangulation.hpp"

namespace traygauge::paper {
namespace {

constexpr double kMinVectorLength = 1e-6;  // of baseline over plane distance, and of the twin's normal

// m with m · x = 1 / depth for rays x of the plane: inverse depth is linear in the picture, and its error
// there is the same everywhere.
bool fit_plane(const MatchTable& matches, std::span<const std::uint32_t> indices,
               const Pose& second_from_first, Vec3& m) {
  NormalEquations<3> equations;
  for (const std::uint32_t i : indices) {
    const RayMatch match = matches[i];
    RayDepths depths;
    if (!intersect_rays(match, second_from_first, depths) || !(depths.first > 0.0)) continue;
    equations.add(-1.0 / depths.first, match.first.homogeneous());
  }
  return equations.solve(0.0, m);
}

}  // namespace

bool find_planar_twin(const MatchTable& matches, std::span<const std::uint32_t> indices,
                      const Pose& second_from_first, Pose& twin_second_from_first) {
  Vec3 m;
  if (!fit_plane(matches, indices, second_from_first, m) || m.norm() < kMinVectorLength) return false;
  // H = R + t mᵀ = R (I + b nᵀ) with |n| = 1, so HᵀH = I + c nᵀ + n cᵀ with c = b + |b|² n / 2: the roles of
  // n and c can be exchanged. |b| and b · n are the same for both motions.
  const Mat3 homography = second_from_first.rotation + second_from_first.translation * m.transpose();
  const Vec3 n = m.normalized();
  const Vec3 b = second_from_first.rotation.transpose() * second_from_first.translation * m.norm();
  const Vec3 c = b + 0.5 * b.squaredNorm() * n;
  const double length = c.norm();
  const double determinant = 1.0 + b.dot(n);
  if (length < kMinVectorLength || std::abs(determinant) < kMinVectorLength) return false;
  const Vec3 twin_n = c / length;
  const Vec3 twin_b = length * n - 0.5 * b.squaredNorm() * twin_n;
  if (!(twin_b.norm() > kMinVectorLength)) return false;
  const Mat3 rotation = homography * (Mat3::Identity() - twin_b * twin_n.transpose() / determinant);
  twin_second_from_first.rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  twin_second_from_first.translation = (twin_second_from_first.rotation * twin_b).normalized();
  return true;
}

}  // namespace traygauge::paper
