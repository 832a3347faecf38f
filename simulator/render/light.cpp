#include "simulator/render/light.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace traygauge {
namespace {

// Solid angle of a small piece of the light is its area times cos(to the light's normal) over the distance
// squared; `cross` is normal times area.
float density_of(const Eigen::Vector3f& cross, const Eigen::Vector3f& direction, float distance_mm) {
  return distance_mm * distance_mm / -cross.dot(direction);
}

}  // namespace

Eigen::Vector3f way_to_light(const AreaLight& light, const Eigen::Vector3f& point_mm,
                             const Eigen::Vector2f& place) {
  return light.corner_mm + place.x() * light.edge_u_mm + place.y() * light.edge_v_mm - point_mm;
}

std::optional<LightSample> sample_light(const AreaLight& light, const Eigen::Vector3f& point_mm,
                                        const Eigen::Vector2f& place) {
  const Eigen::Vector3f to_light = way_to_light(light, point_mm, place);
  const Eigen::Vector3f cross = light.edge_u_mm.cross(light.edge_v_mm);
  if (!(cross.dot(to_light) < 0.0F)) return std::nullopt;
  LightSample sample;
  sample.distance_mm = to_light.norm();
  sample.direction = to_light / sample.distance_mm;
  sample.density = density_of(cross, sample.direction, sample.distance_mm);
  sample.radiance = light.radiance;
  return sample;
}

std::optional<LightSample> meet_light(const AreaLight& light, const Eigen::Vector3f& origin_mm,
                                      const Eigen::Vector3f& direction) {
  const Eigen::Vector3f cross = light.edge_u_mm.cross(light.edge_v_mm);
  const float facing = cross.dot(direction);
  if (!(facing < 0.0F)) return std::nullopt;
  const float distance_mm = cross.dot(light.corner_mm - origin_mm) / facing;
  if (!(distance_mm > 0.0F)) return std::nullopt;
  const Eigen::Vector3f from_corner = origin_mm + distance_mm * direction - light.corner_mm;
  const float area2 = cross.squaredNorm();
  const float u = from_corner.cross(light.edge_v_mm).dot(cross) / area2;
  const float v = light.edge_u_mm.cross(from_corner).dot(cross) / area2;
  if (u < 0.0F || u > 1.0F || v < 0.0F || v > 1.0F) return std::nullopt;
  return LightSample{direction, distance_mm, density_of(cross, direction, distance_mm), light.radiance};
}

}  // namespace traygauge
