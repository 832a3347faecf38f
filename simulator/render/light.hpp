// Area lights as seen from a point.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "simulator/render/scene.hpp"

namespace traygauge {

// A point of a light, seen from elsewhere.
struct LightSample {
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();  // to the light, unit length
  float distance_mm = 0.0F;
  float density = 0.0F;  // how often the direction is drawn, per steradian
  Eigen::Vector3f radiance = Eigen::Vector3f::Zero();
};

// The point of the light at `place` in [0, 1)², drawn evenly over its area. Nothing where the light's back is
// seen.
std::optional<LightSample> sample_light(const AreaLight& light, const Eigen::Vector3f& point_mm,
                                        const Eigen::Vector2f& place);

// From the point to the place on the light: not of unit length.
Eigen::Vector3f way_to_light(const AreaLight& light, const Eigen::Vector3f& point_mm,
                             const Eigen::Vector2f& place);

// The point of the light that a ray of unit direction meets, with the density with which sample_light draws
// that direction.
std::optional<LightSample> meet_light(const AreaLight& light, const Eigen::Vector3f& origin_mm,
                                      const Eigen::Vector3f& direction);

}  // namespace traygauge
