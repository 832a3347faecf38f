// Exact scenes: a camera that looks at the world's origin on the table z = 0, mm.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"
#include "tests/support/cameras.hpp"

namespace traygauge::test {

struct SyntheticView {
  PinholeCamera camera{800.0, 800.0, 319.5, 239.5};
  int width = 640;
  int height = 480;
  Pose camera_from_world;

  Vec3 centre() const { return camera_from_world.inverse().translation; }
  Vec3 world_ray(double x, double y) const {
    return camera_from_world.rotation.transpose() * camera.ray(Vec2(x, y)).homogeneous();
  }
};

// A camera `distance_mm` from the origin, `tilt_rad` off the vertical towards `azimuth_rad`.
inline SyntheticView look_at_origin(double distance_mm, double tilt_rad, double azimuth_rad) {
  const Vec3 direction(std::sin(tilt_rad) * std::cos(azimuth_rad), std::sin(tilt_rad) * std::sin(azimuth_rad),
                       std::cos(tilt_rad));
  SyntheticView view;
  view.camera_from_world = looking_at(direction * distance_mm, Vec3::Zero(), std::numbers::pi);
  return view;
}

inline Plane plane_in_view(const Plane& world, const SyntheticView& view) {
  const Vec3 normal = view.camera_from_world.rotation * world.normal;
  return {normal, world.offset + normal.dot(view.camera_from_world.translation)};
}

inline Pose relative_pose(const SyntheticView& first, const SyntheticView& second) {
  const Pose inverse = first.camera_from_world.inverse();
  return {second.camera_from_world.rotation * inverse.rotation,
          second.camera_from_world * inverse.translation};
}

// Labels of the ellipse with these semi-axes at height `z_mm`: 1 inside, 0 outside.
inline cv::Mat1b render_ellipse(const SyntheticView& view, double semi_x_mm, double semi_y_mm, double z_mm) {
  cv::Mat1b labels(view.height, view.width, std::uint8_t{0});
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Vec3 ray = view.world_ray(x, y);
      const Vec3 point = view.centre() + ray * ((z_mm - view.centre().z()) / ray.z());
      if (std::hypot(point.x() / semi_x_mm, point.y() / semi_y_mm) < 1.0) labels(y, x) = 1;
    }
  }
  return labels;
}

struct HeightFieldPicture {
  cv::Mat1b labels;  // 2 on the item, 1 elsewhere
  cv::Mat1f depth_mm;
};

// Sees the height field `height(x, y)`, which is positive within `reach_mm` of the origin only, on the plane
// z = 0.
template <class Height>
HeightFieldPicture render_height_field(const SyntheticView& view, double top_mm, double reach_mm,
                                       Height&& height) {
  HeightFieldPicture picture{cv::Mat1b(view.height, view.width, std::uint8_t{1}),
                             cv::Mat1f(view.height, view.width)};
  const Vec3 centre = view.centre();
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Vec3 ray = view.world_ray(x, y);
      const auto excess = [&](double t) {
        const Vec3 point = centre + t * ray;
        return point.z() - height(point.x(), point.y());
      };
      double above = (top_mm + 1.0 - centre.z()) / ray.z();
      const double table = -centre.z() / ray.z();
      const auto is_beside = [&](double t) { return (centre + t * ray).head<2>().norm() > 2.0 * reach_mm; };
      if (is_beside(above) && is_beside(table)) {
        picture.depth_mm(y, x) = static_cast<float>(table);
        continue;
      }
      const double step = (table - above) / 100.0;
      double below = above;
      while (below < table && excess(below) > 0.0) {
        above = below;
        below += step;
      }
      if (below >= table) below = table;
      for (int i = 0; i < 24; ++i) {
        const double middle = 0.5 * (above + below);
        (excess(middle) > 0.0 ? above : below) = middle;
      }
      picture.depth_mm(y, x) = static_cast<float>(below);
      if ((centre + below * ray).z() > 1e-6) picture.labels(y, x) = 2;
    }
  }
  return picture;
}

}  // namespace traygauge::test
