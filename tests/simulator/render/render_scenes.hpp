// Small scenes for the renderer.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include "simulator/render/scene.hpp"
#include "simulator/render/view_camera.hpp"

namespace traygauge {

class PlainMaterial final : public Material {
 public:
  explicit PlainMaterial(Reflectance reflectance) : reflectance_(std::move(reflectance)) {}
  Reflectance at(const Eigen::Vector3f& /*point_mm*/, const Eigen::Vector3f& /*normal*/) const override {
    return reflectance_;
  }

 private:
  Reflectance reflectance_;
};

inline std::shared_ptr<const Material> matt(float base) {
  return std::make_shared<PlainMaterial>(Reflectance{Eigen::Vector3f::Constant(base), 0.0F, 0.5F, false});
}

inline TriangleMesh quad(const Eigen::Vector3f& corner, const Eigen::Vector3f& u, const Eigen::Vector3f& v) {
  return {{corner, corner + u, corner + u + v, corner + v}, {}, {{0, 1, 2}, {0, 2, 3}}};
}

// At z = height_mm about the z axis, seen from above.
inline TriangleMesh square(float side_mm, float height_mm) {
  return quad({-0.5F * side_mm, -0.5F * side_mm, height_mm}, {side_mm, 0.0F, 0.0F}, {0.0F, side_mm, 0.0F});
}

// Along meridians and circles of latitude; with normals.
inline TriangleMesh sphere(const Eigen::Vector3f& center, float radius_mm, std::uint32_t bands) {
  TriangleMesh mesh;
  const std::uint32_t columns = 2 * bands;
  for (std::uint32_t i = 0; i <= bands; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double down = std::numbers::pi * i / bands;
      const double around = 2.0 * std::numbers::pi * j / columns;
      const Eigen::Vector3d normal(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                                   std::cos(down));
      mesh.normals.emplace_back(normal.cast<float>());
      mesh.vertices.emplace_back(center + radius_mm * mesh.normals.back());
    }
  }
  for (std::uint32_t i = 0; i < bands; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t a = i * columns + j;
      const std::uint32_t b = i * columns + (j + 1) % columns;
      mesh.triangles.push_back({a, a + columns, b + columns});
      mesh.triangles.push_back({a, b + columns, b});
    }
  }
  return mesh;
}

// A parallelogram light in the plane z = height_mm that shines down.
inline AreaLight ceiling_light(const Eigen::Vector2f& center_mm, const Eigen::Vector2f& size_mm,
                               float height_mm, float radiance) {
  return {{center_mm.x() - 0.5F * size_mm.x(), center_mm.y() - 0.5F * size_mm.y(), height_mm},
          {0.0F, size_mm.y(), 0.0F},
          {size_mm.x(), 0.0F, 0.0F},
          Eigen::Vector3f::Constant(radiance)};
}

// Looks from `eye` at `target`; the picture's right is as level as it can be.
inline Eigen::Isometry3d look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (right.norm() < 1e-9) right = Eigen::Vector3d::UnitX();
  right.normalize();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  pose.translation() = -(pose.linear() * eye);
  return pose;
}

inline ViewCamera camera_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, int width, int height,
                            double focal_px) {
  ViewCamera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = focal_px;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  camera.camera_from_world = look_at(eye, target);
  camera.focus_mm = (target - eye).norm();
  return camera;
}

}  // namespace traygauge
