// What stands before the camera: objects, lights. World: mm, z up, table at z = 0.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "simulator/render/material.hpp"
#include "simulator/render/mesh.hpp"
#include "simulator/render/truth_kind.hpp"

namespace traygauge {

struct SceneObject {
  TriangleMesh mesh;
  std::shared_ptr<const Material> material;
  std::uint8_t label = 0;  // as in labels_N.png
  TruthKind kind = TruthKind::table;
  // Of objects that are not the same everywhere: the kind at a point of the surface, instead of `kind`.
  std::function<TruthKind(const Eigen::Vector3f& point_mm)> kind_at{};
  // Clear glass: seen from the camera it mirrors a little and lets the rest pass straight on, tinted by its
  // material's base at each surface. Light passes it as if it were not there.
  bool is_clear = false;
};

// A parallelogram that shines to the side of edge_u × edge_v. Not visible to the camera itself, only in
// reflections.
struct AreaLight {
  Eigen::Vector3f corner_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f edge_u_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f edge_v_mm = Eigen::Vector3f::Zero();
  Eigen::Vector3f radiance = Eigen::Vector3f::Ones();  // linear RGB
};

struct Scene {
  std::vector<SceneObject> objects;
  std::vector<AreaLight> lights;
  Eigen::Vector3f ambient =
      Eigen::Vector3f::Zero();  // radiance of what rays hit that leave the scene: the room
};

}  // namespace traygauge
