// The rough mirror of Walter 2007 (GGX) with Smith's height-correlated masking (Heitz 2014). Directions are
// local: the normal is z.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace traygauge::ggx {

// Right-handed, the third column is the normal (Duff et al. 2017).
inline Eigen::Matrix3f frame_about(const Eigen::Vector3f& normal) {
  const float sign = std::copysign(1.0F, normal.z());
  const float a = -1.0F / (sign + normal.z());
  const float b = normal.x() * normal.y() * a;
  Eigen::Matrix3f frame;
  frame << 1.0F + sign * normal.x() * normal.x() * a, b, normal.x(),  //
      sign * b, sign + normal.y() * normal.y() * a, normal.y(),       //
      -sign * normal.x(), -normal.y(), normal.z();
  return frame;
}

// Density of the small mirrors' normals at this cosine to the surface's.
inline float distribution(float cosine, float alpha) {
  const float alpha2 = alpha * alpha;
  const float base = cosine * cosine * (alpha2 - 1.0F) + 1.0F;
  return alpha2 / (std::numbers::pi_v<float> * base * base);
}

inline float smith_lambda(float cosine, float alpha) {
  const float cosine2 = cosine * cosine;
  const float tangent2 = std::max(1.0F - cosine2, 0.0F) / cosine2;
  return 0.5F * (std::sqrt(1.0F + alpha * alpha * tangent2) - 1.0F);
}

// Share of the small mirrors that is seen from a direction, from two directions.
inline float seen(float cosine, float alpha) {
  return 1.0F / (1.0F + smith_lambda(cosine, alpha));
}
inline float seen_both_ways(float cosine_1, float cosine_2, float alpha) {
  return 1.0F / (1.0F + smith_lambda(cosine_1, alpha) + smith_lambda(cosine_2, alpha));
}

// A normal of the small mirrors as often as the viewer sees it (Heitz 2018, listing 1); `place` in [0, 1)².
inline Eigen::Vector3f visible_normal(const Eigen::Vector3f& to_viewer, float alpha,
                                      const Eigen::Vector2f& place) {
  const Eigen::Vector3f stretched =
      Eigen::Vector3f(alpha * to_viewer.x(), alpha * to_viewer.y(), to_viewer.z()).normalized();
  const float length2 = stretched.x() * stretched.x() + stretched.y() * stretched.y();
  const Eigen::Vector3f side = length2 > 0.0F
                                   ? Eigen::Vector3f(-stretched.y(), stretched.x(), 0.0F) / std::sqrt(length2)
                                   : Eigen::Vector3f(Eigen::Vector3f::UnitX());
  const Eigen::Vector3f up = stretched.cross(side);
  const float radius = std::sqrt(place.x());
  const float angle = 2.0F * std::numbers::pi_v<float> * place.y();
  const float across = radius * std::cos(angle);
  const float share = 0.5F * (1.0F + stretched.z());
  const float along = (1.0F - share) * std::sqrt(1.0F - across * across) + share * radius * std::sin(angle);
  const Eigen::Vector3f normal =
      across * side + along * up +
      std::sqrt(std::max(0.0F, 1.0F - across * across - along * along)) * stretched;
  return Eigen::Vector3f(alpha * normal.x(), alpha * normal.y(), std::max(0.0F, normal.z())).normalized();
}

}  // namespace traygauge::ggx
