// Simple solids that stand for a food item, and how one is fitted to what a camera sees of it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge::tables {

// All stand on the plane z = 0 and are convex.
enum class Template : std::uint8_t {
  cap,             // paraboloid over an ellipse
  half_ellipsoid,  // upper half
  cylinder,        // over an ellipse
  box,
};
inline constexpr std::array<Template, 4> kTemplates = {Template::cap, Template::half_ellipsoid,
                                                       Template::cylinder, Template::box};

struct Solid {
  Template shape = Template::cap;
  Vec2 centre_mm = Vec2::Zero();
  Vec2 half_axes_mm = Vec2::Ones();
  double azimuth_rad = 0.0;  // of the first axis
  double height_mm = 0.0;
};

double footprint_mm2(const Solid& solid);
double volume_ml(const Solid& solid);
// Height of its surface over a point of the plane, as a share of height_mm: 1 at the top, 0 outside.
double relative_height(const Solid& solid, const Vec2& place_mm);
// Points of its surface: their hull in a picture is its silhouette.
std::vector<Vec3> silhouette_points(const Solid& solid);

// An item in an undistorted picture. The dish frame lies on the dish's bottom, z up.
struct ItemView {
  PinholeCamera camera;
  Pose camera_from_dish;
  cv::Mat mask;  // 8-bit: non-zero on the item
};

struct SilhouetteFit {
  Solid solid;
  double overlap = 0.0;  // intersection over union of silhouette and mask
};

// The solid of this shape whose silhouette overlaps the mask most; its height follows from the area of its
// footprint by `height_mm`. The mask holds at least one pixel.
SilhouetteFit fit_silhouette(const ItemView& view, Template shape,
                             const std::function<double(double footprint_mm2)>& height_mm);

// Where the line of sight through `pixel` meets the plane at this height over the dish's bottom.
Vec3 sight_at_height(const ItemView& view, const Vec2& pixel, double height_mm);

}  // namespace traygauge::tables
