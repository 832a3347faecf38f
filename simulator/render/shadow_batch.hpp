// How much of a light is hidden.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "simulator/render/ray_scene.hpp"

namespace traygauge {

// Up to so many shadow rays, traced together.
struct ShadowBatch {
  static constexpr std::size_t kCapacity = 16;
  static constexpr float kShadowEnd = 0.9999F;  // of the way to a light: none lies on it
  std::array<Ray, kCapacity> rays;
  std::array<std::uint8_t, kCapacity> is_occluded{};
  std::size_t count = 0;

  bool is_full() const { return count == kCapacity; }

  // From a surface all the way to a light.
  void add(const SurfaceHit& hit, const Eigen::Vector3f& way_mm) {
    rays[count++] = {RayScene::leave(hit, way_mm), way_mm, kShadowEnd};
  }

  void trace(const RayScene& scene, RayBundle bundle = RayBundle::coherent) {
    scene.occlude({rays.data(), count}, {is_occluded.data(), count}, bundle);
  }

  bool is_all_alike() const {
    return std::all_of(is_occluded.begin(), is_occluded.begin() + static_cast<std::ptrdiff_t>(count),
                       [this](std::uint8_t hidden) { return hidden == is_occluded[0]; });
  }
};

// How much of a light is seen: shares of what diffuse surfaces would get from it without shadows.
struct Visibility {
  Eigen::Vector3f seen = Eigen::Vector3f::Zero();
  Eigen::Vector3f all = Eigen::Vector3f::Zero();

  void add(const Eigen::Vector3f& amount, bool is_hidden) {
    all += amount;
    if (!is_hidden) seen += amount;
  }
};

}  // namespace traygauge
