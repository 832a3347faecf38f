// What a light adds to a surface, before shadows.
#pragma once

#include <Eigen/Core>

#include "simulator/render/light.hpp"
#include "simulator/render/light_quadrature.hpp"
#include "simulator/render/ray_scene.hpp"
#include "simulator/render/surface_response.hpp"

namespace traygauge {

// Radiance to the viewer: of the base by the whole light where it is in full view, of the coat by a point of
// it.
Eigen::Vector3f lit(const SurfaceResponse& response, const SurfaceHit& hit, const LightSample& light,
                    const LightQuadrature& whole);

// How strongly a point of a light shines on a surface, in any unit that the light's points share.
float light_weight(const AreaLight& light, const SurfaceHit& hit, const Eigen::Vector3f& way_mm);

}  // namespace traygauge
