#include "simulator/render/light_quadrature.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace traygauge {

LightQuadrature::LightQuadrature(const AreaLight& light)
    : corner_mm_(light.corner_mm), cross_(light.edge_u_mm.cross(light.edge_v_mm)) {
  const float outer = 0.5F * std::sqrt(0.6F);
  const std::array<float, 3> places = {0.5F - outer, 0.5F, 0.5F + outer};
  constexpr std::array<float, 3> kWeights = {5.0F / 18.0F, 8.0F / 18.0F, 5.0F / 18.0F};
  for (int i = 0; i < kNodes; ++i) {
    const auto column = static_cast<std::size_t>(i % 3);
    const auto row = static_cast<std::size_t>(i / 3) % 3;
    const Eigen::Vector3f node_mm =
        light.corner_mm + places[column] * light.edge_u_mm + places[row] * light.edge_v_mm;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      nodes_mm_[static_cast<std::size_t>(axis)][i] = node_mm[axis];
    if (i < 9) weights_[i] = kWeights[column] * kWeights[row];
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const float u = light.edge_u_mm[axis];
    const float v = light.edge_v_mm[axis];
    corners_mm_[static_cast<std::size_t>(axis)] = light.corner_mm[axis] + Eigen::Array4f(0.0F, u, v, u + v);
  }
}

std::optional<float> LightQuadrature::irradiance(const Eigen::Vector3f& point_mm,
                                                 const Eigen::Vector3f& normal) const {
  const float before_mm3 = cross_.dot(point_mm - corner_mm_);  // the light's plane, times its area
  if (!(before_mm3 > 0.0F)) return std::nullopt;
  const Eigen::Array4f corner_heights_mm =
      corners_mm_[0] * normal.x() + corners_mm_[1] * normal.y() + corners_mm_[2] * normal.z();
  if (!(corner_heights_mm > normal.dot(point_mm)).all()) return std::nullopt;
  const Nodes x = nodes_mm_[0] - point_mm.x();
  const Nodes y = nodes_mm_[1] - point_mm.y();
  const Nodes z = nodes_mm_[2] - point_mm.z();
  const Nodes square = x * x + y * y + z * z;
  const Nodes height = normal.x() * x + normal.y() * y + normal.z() * z;
  // The cosine at the light is the distance to its plane over the way's length.
  return before_mm3 * (weights_ * height / (square * square)).sum();
}

}  // namespace traygauge
