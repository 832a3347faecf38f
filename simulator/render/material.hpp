// How surfaces return light.
#pragma once

#include <Eigen/Core>

namespace traygauge {

// At one point: a diffuse base under a clear coat, or metal. Colours are linear RGB from 0 to 1.
struct Reflectance {
  Eigen::Vector3f base = Eigen::Vector3f::Constant(0.5F);
  float coat =
      0.04F;  // share of light that is mirrored at normal incidence: 0.04 for glaze, oil, water; 0: matt
  float roughness = 0.5F;  // of the coat or the metal, GGX alpha
  bool is_metal = false;   // base is then the mirrored share at normal incidence
};

// A pattern in space or on the surface; evaluated by many threads at once.
class Material {
 public:
  virtual ~Material() = default;
  // In the world's frame, mm.
  virtual Reflectance at(const Eigen::Vector3f& point_mm, const Eigen::Vector3f& normal) const = 0;
};

}  // namespace traygauge
