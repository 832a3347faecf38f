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
  static constexpr std::size_t kNodes = 9;
  static constexpr std::size_t kCorners = 4;

  std::array<Eigen::Vector3f, kNodes> nodes_mm_;
  std::array<float, kNodes> weights_{};
  std::array<Eigen::Vector3f, kCorners> corners_mm_;
  Eigen::Vector3f cross_;  // normal times area
};

}  // namespace traygauge
