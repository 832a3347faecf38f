#include "simulator/render/clear_objects.hpp"

#include <cmath>

#include "simulator/render/light.hpp"

namespace traygauge {
namespace {

constexpr int kMostSurfaces = 8;        // both sides of both walls of two bowls
constexpr float kNormalMirror = 0.04F;  // of glass, at normal incidence

}  // namespace

ClearObjects::View ClearObjects::look_through(const Ray& ray, float distance) const {
  View view;
  Ray rest = ray;
  float gone = 0.0F;
  for (int surface = 0; surface < kMostSurfaces; ++surface) {
    SurfaceHit hit;
    clear_.intersect({&rest, 1}, {&hit, 1}, RayBundle::scattered);
    if (hit.object == nullptr || gone + hit.distance >= distance) return view;
    gone += hit.distance;
    if (surface == 0) view.nearest = hit;
    const Eigen::Vector3f way = ray.direction.normalized();
    const float cosine = std::abs(hit.normal.dot(way));
    const float mirror = kNormalMirror + (1.0F - kNormalMirror) * std::pow(1.0F - cosine, 5.0F);
    view.mirrored += mirror * view.passed.cwiseProduct(mirrored_light(hit, way));
    view.passed =
        (1.0F - mirror) * view.passed.cwiseProduct(hit.object->material->at(hit.point_mm, hit.normal).base);
    rest.origin_mm = RayScene::leave(hit, ray.direction);
  }
  return view;
}

// Lights as they are; of surfaces only what they send back of the room's light: glass mirrors little of it.
Eigen::Vector3f ClearObjects::mirrored_light(const SurfaceHit& hit, const Eigen::Vector3f& direction) const {
  const Eigen::Vector3f way = direction - 2.0F * direction.dot(hit.normal) * hit.normal;
  const Ray ray{RayScene::leave(hit, way), way};
  SurfaceHit seen;
  opaque_.intersect({&ray, 1}, {&seen, 1}, RayBundle::scattered);
  const Scene& scene = opaque_.scene();
  for (const AreaLight& light : scene.lights) {
    const auto met = meet_light(light, ray.origin_mm, way);
    if (met && (seen.object == nullptr || met->distance_mm < seen.distance)) return met->radiance;
  }
  if (seen.object == nullptr) return scene.ambient;
  return seen.object->material->at(seen.point_mm, seen.normal).base.cwiseProduct(scene.ambient);
}

}  // namespace traygauge
