// Irradiance by a whole area light without sampling.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "simulator/render/scene.hpp"

namespace traygauge {

// Gauss and Legendre's rule with 3 × 3 points: within 0.1 % where the light is no longer than it is far away.
// Lights that are seen by half, over the surface's horizon or from behind, are left to sampling.
class LightQuadrature {
 public:
  explicit LightQuadrature(const AreaLight& light);

  // Of a surface by a light of radiance 1 that nothing hides.
  std::optional<float> irradiance(const Eigen::Vector3f& point_mm, const Eigen::Vector3f& normal) const;

 private:
  static constexpr int kNodes = 12;  // the last three weigh nothing: whole vectors of four
  using Nodes = Eigen::Array<float, kNodes, 1>;

  std::array<Nodes, 3> nodes_mm_;  // x, y, z
  Nodes weights_ = Nodes::Zero();
  std::array<Eigen::Array4f, 3> corners_mm_;  // x, y, z
  Eigen::Vector3f corner_mm_;
  Eigen::Vector3f cross_;  // normal times area
};

}  // namespace traygauge
