#include "simulator/render/lit_surface.hpp"

#include <Eigen/Geometry>
#include <numbers>

namespace traygauge {

Eigen::Vector3f lit(const SurfaceResponse& response, const SurfaceHit& hit, const LightSample& light,
                    const LightQuadrature& whole) {
  Eigen::Vector3f factor = Eigen::Vector3f::Zero();
  if (response.has_base()) {
    const auto irradiance = whole.irradiance(hit.point_mm, hit.normal);
    if (irradiance) {
      const float entering = response.base_entry(light.direction) * *irradiance;
      factor = response.base_albedo() * (entering * std::numbers::inv_pi_v<float>);
    } else {
      factor = response.base_factor(light.direction) / light.density;
    }
  }
  if (response.has_coat()) {
    const SurfaceResponse::CoatFactor coat = response.coat_factor(light.direction);
    const float mirrored = response.is_sharp() ? response.mirrored_fraction() * coat.density : 0.0F;
    factor += coat.factor / (light.density + mirrored);
  }
  return factor.cwiseProduct(light.radiance);
}

float light_weight(const AreaLight& light, const SurfaceHit& hit, const Eigen::Vector3f& way_mm) {
  const float square = way_mm.squaredNorm();
  return -light.edge_u_mm.cross(light.edge_v_mm).dot(way_mm) * hit.normal.dot(way_mm) / (square * square);
}

}  // namespace traygauge
