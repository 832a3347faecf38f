// A tiny exact scene for tests: one textured solid on a textured dish disc, seen by pinhole cameras. Depth,
// labels and volume follow from closed forms (the height field is ray-marched, then bisected).
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

enum class SolidShape : std::uint8_t {
  none,          // the bare dish
  cone,          // upright, radius × height
  hemisphere,    // of the radius
  box,           // square of side 2 radius, × height
  height_field,  // height cos²(πx / 2 radius) cos²(πy / 2 radius) over the same square
};

// World: the dish is the disc z = 0 around the origin, z up, lengths in mm. Beyond it the plane goes on.
struct SyntheticScene {
  SolidShape shape = SolidShape::none;
  double radius_mm = 50.0;
  double height_mm = 30.0;
  Vec2 centre_mm = Vec2::Zero();  // of the solid
  double dish_radius_mm = 130.0;
  double texture_mm = 8.0;  // longest wavelength of the texture; it has three octaves
  std::uint32_t texture_seed = 1;
  Vec2 solid_texture_shift_mm = Vec2::Zero();  // of the solid alone, as where it was moved with its centre

  double volume_ml() const;
  double height(const Vec2& point_mm) const;   // of the upper surface above the dish
  double texture(const Vec3& point_mm) const;  // grey value, 0…255

  // First hit of the ray origin + t * direction, t > 0.
  bool intersect(const Vec3& origin, const Vec3& direction, double& t) const;
};

struct SyntheticCamera {
  PinholeCamera pinhole;
  int width = 0;
  int height = 0;
  Pose camera_from_world;

  Vec3 centre() const { return camera_from_world.inverse().translation; }
  Vec3 direction(const Vec2& pixel) const;  // in the world; one unit is 1 mm along the optical axis
  Vec2 project(const Vec3& point_mm) const;
};

// A camera at `position` whose axis goes through `target`, rolled about it; principal point in the middle.
SyntheticCamera look_at(const Vec3& position, const Vec3& target, double roll_rad, double focal_px, int width,
                        int height);

Pose second_from_first(const SyntheticCamera& first, const SyntheticCamera& second);

struct RenderedView {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> gray;
  std::vector<std::uint8_t> labels;  // 0 outside, 1 the dish, 2 the solid
  std::vector<double> depth_mm;      // along the optical axis, at pixel centres; 0 where nothing is

  ImageView<const std::uint8_t> gray_view() const { return {gray.data(), width, height}; }
  ImageView<const std::uint8_t> label_view() const { return {labels.data(), width, height}; }
  double depth(int x, int y) const {
    return depth_mm[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)];
  }
};

// Grey averages samples × samples rays a pixel.
RenderedView render(const SyntheticScene& scene, const SyntheticCamera& camera, int samples = 3);

// The surface point behind a pixel; false when there is none.
bool surface_point(const SyntheticScene& scene, const SyntheticCamera& camera, const Vec2& pixel,
                   Vec3& point);

// Whether nothing hides a surface point from a camera, and it lies in the picture.
bool is_visible(const SyntheticScene& scene, const SyntheticCamera& camera, const Vec3& point);

}  // namespace traygauge
