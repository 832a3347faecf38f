// What a capture's truth says about where things are: cameras, dishes, and the surface that its first view
// sees.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/truth.hpp"

namespace traygauge {

Pose pose_of(const WorldToCamera& matrix);

// The dish labelled `label` in the world; the world's origin where the truth names no dishes.
std::optional<TruthDish> true_place(const Truth& truth, std::uint8_t label);

// The surface that the depth picture of view 0 shows.
class TrueSurface {
 public:
  // Nothing when the capture has no depth_0.png or no pose for its view. Throws InputError.
  static std::optional<TrueSurface> read(const Capture& capture, const Truth& truth);

  // Where the line of sight from `eye_mm` along the unit vector `direction` first meets the surface, near the
  // distance `about_mm`; nothing where view 0 does not see what lies there.
  std::optional<double> distance_mm(const Vec3& eye_mm, const Vec3& direction, double about_mm) const;

 private:
  // How far the point lies behind the surface, along the axis of view 0.
  std::optional<double> behind_mm(const Vec3& world_mm) const;

  LensModel lens_;
  Pose camera_from_world_;
  DepthPicture depth_;
};

}  // namespace traygauge
