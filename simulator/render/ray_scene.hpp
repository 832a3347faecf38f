// A scene made ready for rays, by Embree.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>

#include "simulator/render/scene.hpp"

namespace traygauge {

struct Ray {
  Eigen::Vector3f origin_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();  // any length
  float end = 1e30F;                                     // in lengths of the direction
};

// Where a ray meets a surface. The normals are of unit length and on the side that the ray comes from.
struct SurfaceHit {
  const SceneObject* object = nullptr;  // null: nothing is met
  Eigen::Vector3f point_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f flat_normal = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  // interpolated
  Eigen::Vector3f smooth_point_mm =
      Eigen::Vector3f::Zero();  // on the rounded surface that the normals describe
  bool is_smooth = false;       // with a rounded surface
  float distance = 0.0F;        // in lengths of the ray's direction
};

// Whether neighbouring rays of a call take about the same way: a hint for speed alone.
enum class RayBundle : std::uint8_t { scattered, coherent };

enum class ObjectChoice : std::uint8_t { opaque, clear };

// Rays may be traced by many threads at once.
class RayScene {
 public:
  // Of the scene's opaque or of its clear objects. Refers to the scene, which must outlive it. Throws
  // std::invalid_argument for an object without material or with indices or normals that do not fit its
  // vertices, std::runtime_error when Embree fails.
  explicit RayScene(const Scene& scene, ObjectChoice choice = ObjectChoice::opaque);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  const Scene& scene() const { return scene_; }
  bool is_empty() const { return is_empty_; }

  // As many hits as rays.
  void intersect(std::span<const Ray> rays, std::span<SurfaceHit> hits, RayBundle bundle) const;
  // 1 where something lies between a ray's origin and its end.
  void occlude(std::span<const Ray> rays, std::span<std::uint8_t> is_occluded, RayBundle bundle) const;

  // Whether light may go this way: not into the surface.
  static bool is_above(const SurfaceHit& hit, const Eigen::Vector3f& direction);
  // Where a new ray in this direction may start without meeting the surface that it leaves.
  static Eigen::Vector3f leave(const SurfaceHit& hit, const Eigen::Vector3f& direction);

 private:
  struct Handles;

  SurfaceHit hit_of(const Ray& ray, unsigned geometry, unsigned triangle, float u, float v,
                    float distance) const;

  const Scene& scene_;
  std::unique_ptr<Handles> handles_;
  bool is_empty_ = true;
};

}  // namespace traygauge
