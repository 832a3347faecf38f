// Clear glass between the camera and what is seen.
#pragma once

#include <Eigen/Core>

#include "simulator/render/ray_scene.hpp"

namespace traygauge {

class ClearObjects {
 public:
  // Refers to both: the scene's opaque objects and its clear ones.
  ClearObjects(const RayScene& opaque, const RayScene& clear) : opaque_(opaque), clear_(clear) {}

  bool is_empty() const { return clear_.is_empty(); }

  struct View {
    Eigen::Vector3f passed = Eigen::Vector3f::Ones();  // share of the light from behind that arrives
    Eigen::Vector3f mirrored = Eigen::Vector3f::Zero();
    SurfaceHit nearest;  // the first clear surface; its object is null where there is none
  };
  // Along a ray to the opaque surface that it meets at `distance`, in lengths of its direction.
  View look_through(const Ray& ray, float distance) const;

 private:
  Eigen::Vector3f mirrored_light(const SurfaceHit& hit, const Eigen::Vector3f& direction) const;

  const RayScene& opaque_;
  const RayScene& clear_;
};

}  // namespace traygauge
