#include "core/paper/pose/essential_decomposition.hpp"

#include <cmath>

#include "core/geometry/triangulation.hpp"

namespace traygauge::paper {
namespace {

// The rotation R of E = [t]× R, t of unit length (Horn 1990): R = cof E − [t]× E.
Mat3 rotation_for(const Mat3& essential, const Vec3& translation) {
  Mat3 cofactors;
  for (Eigen::Index i = 0; i < 3; ++i) {
    cofactors.row(i) = essential.row((i + 1) % 3).cross(essential.row((i + 2) % 3));
  }
  const Mat3 rotation = cofactors - skew(translation) * essential;
  return Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
}

}  // namespace

std::array<Pose, 4> decompose_essential(const Mat3& essential) {
  const Mat3 scaled = essential * (std::sqrt(2.0) / essential.norm());  // singular values 1, 1, 0
  Vec3 translation = Vec3::Zero();  // left null vector: the longest cross product of two columns
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vec3 cross = scaled.col(i).cross(scaled.col((i + 1) % 3));
    if (cross.squaredNorm() > translation.squaredNorm()) translation = cross;
  }
  translation.normalize();
  const Mat3 one = rotation_for(scaled, translation);
  const Mat3 twisted = rotation_for(scaled, -translation);
  return {Pose{one, translation}, Pose{one, -translation}, Pose{twisted, translation},
          Pose{twisted, -translation}};
}

std::size_t count_in_front(const MatchTable& matches, std::span<const std::uint32_t> indices,
                           const Pose& second_from_first, double min_parallax_rad) {
  const double max_cosine = std::cos(min_parallax_rad);
  std::size_t count = 0;
  for (const std::uint32_t i : indices) {
    const RayMatch match = matches[i];
    const Vec3 a = second_from_first.rotation * match.first.homogeneous();
    const Vec3 b = match.second.homogeneous();
    const double cosine = a.dot(b) / std::sqrt(a.squaredNorm() * b.squaredNorm());
    RayDepths depths;
    if (cosine < 0.0 || cosine > max_cosine || !intersect_rays(match, second_from_first, depths)) continue;
    if (depths.first > 0.0 && depths.second > 0.0) ++count;
  }
  return count;
}

}  // namespace traygauge::paper
