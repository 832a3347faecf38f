#include "core/geometry/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace traygauge {
bool intersect_rays(const RayMatch& match, const Pose& second_from_first, RayDepths& depths) {
  const Vec3 a = second_from_first.rotation * match.first.homogeneous();
  const Vec3 b = match.second.homogeneous();
  const Vec3& t = second_from_first.translation;
  const Vec3 normal = b.cross(a);
  const double squared_sine_scaled = normal.squaredNorm();
  if (!(squared_sine_scaled > kRounding * a.squaredNorm() * b.squaredNorm())) return false;
  depths.first =
      t.cross(b).dot(normal) / squared_sine_scaled;  // depth b = depth' a + t, crossed with b and a
  depths.second = t.cross(a).dot(normal) / squared_sine_scaled;
  return true;
}

RayMatch correct_match(const RayMatch& match, const Pose& second_from_first) {
  const Mat3 e = essential_matrix(second_from_first);
  const Vec3 x1 = match.first.homogeneous();
  const Vec3 x2 = match.second.homogeneous();
  const Eigen::Matrix2d inner = e.topLeftCorner<2, 2>();
  const Vec2 line2 = (e * x1).head<2>();
  const Vec2 line1 = (e.transpose() * x2).head<2>();
  const double a = line2.dot(inner * line1);
  const double b = 0.5 * (line1.squaredNorm() + line2.squaredNorm());
  const double c = x2.dot(e * x1);
  const double d = std::sqrt(std::max(b * b - a * c, 0.0));
  if (!(b + d > 0.0)) return match;  // both points are epipoles
  const double step = c / (b + d);
  const Vec2 normal2 = line2 - inner * (step * line1);
  const Vec2 normal1 = line1 - inner.transpose() * (step * line2);
  const double squared = normal1.squaredNorm() + normal2.squaredNorm();
  if (!(squared > 0.0)) return match;
  const double last_step = step * 2.0 * d / squared;
  return {match.first - last_step * normal1, match.second - last_step * normal2};
}

bool triangulate(const RayMatch& match, const Pose& second_from_first, Vec3& point_in_first) {
  const RayMatch corrected = correct_match(match, second_from_first);
  RayDepths depths;
  if (!intersect_rays(corrected, second_from_first, depths)) return false;
  if (!(depths.first > 0.0) || !(depths.second > 0.0)) return false;
  point_in_first = depths.first * corrected.first.homogeneous();
  return true;
}

void triangulate_all(std::span<const RayMatch> matches, std::span<const std::uint8_t> inliers,
                     const Pose& second_from_first, std::span<Vec3> points_in_first,
                     std::span<std::uint8_t> triangulated) {
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const bool found = inliers[i] != 0 && triangulate(matches[i], second_from_first, points_in_first[i]);
    triangulated[i] = found ? 1 : 0;
  }
}

double parallax_angle_rad(const RayMatch& match, const Mat3& rotation) {
  const Vec3 a = rotation * match.first.homogeneous();
  const Vec3 b = match.second.homogeneous();
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace traygauge
