#include "simulator/render/light_quadrature.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace traygauge {

LightQuadrature::LightQuadrature(const AreaLight& light) : cross_(light.edge_u_mm.cross(light.edge_v_mm)) {
  const float outer = 0.5F * std::sqrt(0.6F);
  const std::array<float, 3> places = {0.5F - outer, 0.5F, 0.5F + outer};
  constexpr std::array<float, 3> kWeights = {5.0F / 18.0F, 8.0F / 18.0F, 5.0F / 18.0F};
  for (std::size_t i = 0; i < kNodes; ++i) {
    nodes_mm_[i] = light.corner_mm + places[i % 3] * light.edge_u_mm + places[i / 3] * light.edge_v_mm;
    weights_[i] = kWeights[i % 3] * kWeights[i / 3];
  }
  corners_mm_ = {light.corner_mm, light.corner_mm + light.edge_u_mm, light.corner_mm + light.edge_v_mm,
                 light.corner_mm + light.edge_u_mm + light.edge_v_mm};
}

std::optional<float> LightQuadrature::irradiance(const Eigen::Vector3f& point_mm,
                                                 const Eigen::Vector3f& normal) const {
  if (!(cross_.dot(point_mm - corners_mm_[0]) > 0.0F)) return std::nullopt;
  const float horizon_mm = normal.dot(point_mm);
  for (const Eigen::Vector3f& corner : corners_mm_) {
    if (!(normal.dot(corner) > horizon_mm)) return std::nullopt;
  }
  float sum = 0.0F;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const Eigen::Vector3f way = nodes_mm_[i] - point_mm;
    const float square = way.squaredNorm();
    sum += weights_[i] * normal.dot(way) / (square * square);
  }
  return sum * cross_.dot(point_mm - corners_mm_[0]);  // the cosine at the light, times distance and area
}

}  // namespace traygauge
