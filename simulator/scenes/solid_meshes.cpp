#include "simulator/scenes/solid_meshes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "simulator/scenes/mesh_tools.hpp"

namespace traygauge {
namespace {

using Loop = std::vector<Eigen::Vector3f>;

constexpr int kRingPoints = 64;
constexpr int kQuarterRings = 32;  // of a superquadric, from its middle to an end
constexpr int kEndRings = 8;       // rings of a round end

TriangleMesh smooth_skin(const std::vector<Loop>& loops) {
  TriangleMesh mesh = skin_of_loops(loops);
  add_smooth_normals(mesh);
  return mesh;
}

double signed_power(double value, double exponent) {
  return std::copysign(std::pow(std::abs(value), exponent), value);
}

}  // namespace

TriangleMesh turned_mesh(std::span<const std::pair<double, double>> section_mm) {
  std::vector<Loop> loops;
  for (const auto& [radius_mm, height_mm] : section_mm) {
    Loop& loop = loops.emplace_back();
    for (int i = 0; i < kRingPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRingPoints;
      loop.emplace_back(
          Eigen::Vector3d(radius_mm * std::cos(angle), radius_mm * std::sin(angle), height_mm).cast<float>());
    }
  }
  return smooth_skin(loops);
}

TriangleMesh limb_mesh(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm, double from_radius_mm,
                       double to_radius_mm) {
  const Eigen::Vector3d axis = (to_mm - from_mm).normalized();
  const Eigen::Vector3d side = axis.unitOrthogonal();
  const Eigen::Vector3d other = axis.cross(side);
  std::vector<Loop> loops;
  const auto add_ring = [&](const Eigen::Vector3d& end_mm, double radius_mm, double slope_rad) {
    Loop& loop = loops.emplace_back();
    const Eigen::Vector3d middle = end_mm + radius_mm * std::sin(slope_rad) * axis;
    for (int i = 0; i < kRingPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRingPoints;
      const Eigen::Vector3d out = std::cos(angle) * side + std::sin(angle) * other;
      loop.emplace_back((middle + radius_mm * std::cos(slope_rad) * out).cast<float>());
    }
  };
  const auto slope = [](int ring) { return 0.5 * std::numbers::pi * (ring + 0.1) / (kEndRings + 0.1); };
  for (int ring = kEndRings; ring >= 0; --ring) add_ring(to_mm, to_radius_mm, slope(ring) * 0.99);
  for (int ring = 0; ring <= kEndRings; ++ring) add_ring(from_mm, from_radius_mm, -slope(ring) * 0.99);
  return smooth_skin(loops);
}

TriangleMesh superquadric_mesh(const Eigen::Vector3d& semi_mm, double side_exponent, double height_exponent) {
  std::vector<Loop> loops;
  for (int ring = 1; ring < 2 * kQuarterRings; ++ring) {
    const double latitude = 0.5 * std::numbers::pi * (1.0 - static_cast<double>(ring) / kQuarterRings);
    const double level = signed_power(std::sin(latitude), 2.0 / height_exponent);
    const double width = std::pow(std::cos(latitude), 2.0 / height_exponent);
    Loop& loop = loops.emplace_back();
    for (int i = 0; i < kRingPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRingPoints;
      const Eigen::Vector3d share(width * signed_power(std::cos(angle), 2.0 / side_exponent),
                                  width * signed_power(std::sin(angle), 2.0 / side_exponent), level);
      loop.emplace_back(share.cwiseProduct(semi_mm).cast<float>());
    }
  }
  return smooth_skin(loops);
}

}  // namespace traygauge
