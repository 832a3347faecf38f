// Light along the rays of a pixel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "simulator/render/camera_rays.hpp"
#include "simulator/render/clear_objects.hpp"
#include "simulator/render/light_gatherer.hpp"
#include "simulator/render/light_quadrature.hpp"
#include "simulator/render/ray_scene.hpp"
#include "simulator/render/render_settings.hpp"
#include "simulator/render/sample_sequence.hpp"
#include "simulator/render/surface_response.hpp"

namespace traygauge {

// How many rays tell enough about a pixel: half of the usual, or as many as at edges.
enum class PixelKind : std::uint8_t { calm, usual, busy };

// The mean over a pixel's rays. Its radiance is direct + albedo · indirect; these are kept apart, because
// indirect light varies slowly over a surface and can be smoothed.
struct PixelLight {
  Eigen::Vector3f direct = Eigen::Vector3f::Zero();    // from lights, mirrored, or from the room itself
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();    // of the diffuse base
  Eigen::Vector3f indirect = Eigen::Vector3f::Zero();  // radiance that arrives: mean weighed by albedo
  bool is_one_surface = true;                          // that all rays meet, without a step
  PixelKind kind = PixelKind::usual;                   // what its rays would have called for
};

// Next-event estimation at every surface; for coats and metal together with the mirrored ray by multiple
// importance sampling (Veach 1995, balance heuristic). Surfaces that are seen only by way of others are taken
// as diffuse.
class PathTracer {
 public:
  // Refers to scene, clear objects and rays.
  PathTracer(const RayScene& scene, const ClearObjects& clear, const CameraRays& rays,
             const RenderSettings& settings);

  // The number of rays must not depend on the pixel's own: a mean that stops early where the first rays look
  // alike is biased. Its neighbours tell.
  PixelLight trace(int x, int y, PixelKind expected) const;

 private:
  static constexpr std::uint32_t kRound = 8;  // rays traced at once, at most
  struct Round;

  struct Sum;

  static std::uint32_t in_rounds(int rays);  // rounded up to whole rounds
  void trace_round(Round& round, const CameraRays::Pixel& pixel, Sum& sum) const;
  void aim(Round& round, const CameraRays::Pixel& pixel, Sum& sum) const;
  void look_for_steps(const Round& round, Sum& sum) const;
  void add_lights(Round& round, Sum& sum) const;
  void add_light(Round& round, std::uint32_t number, Sum& sum) const;
  Eigen::Vector3f seen_fraction(const Round& round, std::uint32_t number) const;
  void add_mirrored(Round& round, Sum& sum) const;
  std::size_t indirect_rays(const Round& round, const Sum& sum) const;
  void add_indirect(Round& round, Sum& sum) const;
  void look_for_change(const Round& round, Sum& sum) const;
  PixelKind kind_of(const Sum& sum) const;

  const RayScene& scene_;
  const ClearObjects& clear_;
  const CameraRays& rays_;
  RenderSettings settings_;
  std::uint32_t few_, usual_, most_;  // rays of a pixel
  LightGatherer gatherer_;
  std::vector<LightQuadrature> quadratures_;  // of the scene's lights
  std::uint32_t seed_;
};

}  // namespace traygauge
