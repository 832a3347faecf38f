// Light that arrives along rays from the surfaces they end on.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>

#include "simulator/render/ray_scene.hpp"
#include "simulator/render/sample_sequence.hpp"

namespace traygauge {

// Follows paths over diffuse surfaces, all paths of a call together, so that their rays share packets.
class LightGatherer {
 public:
  static constexpr std::size_t kMostPaths = 8;

  // Refers to the scene. `bounces`: surfaces on a path, after the one that it ends on.
  LightGatherer(const RayScene& scene, int bounces) : scene_(scene), bounces_(bounces) {}

  struct Path {
    SurfaceHit hit;           // where its ray ended; nothing: the room
    std::uint32_t index = 0;  // of its points in the sequence
    // How much its light counts, in shares of the picture's. Paths that count for little end early by chance,
    // and the others make up for them.
    float weight = 1.0F;
    Eigen::Vector3f arriving = Eigen::Vector3f::Zero();  // the result: radiance, but not from lights directly
  };

  // Up to kMostPaths. Uses three decisions of the sequence for each surface, from `decision` on.
  void gather(std::span<Path> paths, const SampleSequence& sequence, std::uint32_t decision) const;

 private:
  struct Leg;
  struct Legs;

  void scatter(Legs& legs) const;
  void add_light(Legs& legs, const SampleSequence& sequence, std::uint32_t decision) const;
  void go_on(Legs& legs, const SampleSequence& sequence, std::uint32_t decision) const;

  const RayScene& scene_;
  int bounces_;
};

}  // namespace traygauge
