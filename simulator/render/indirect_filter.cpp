#include "simulator/render/indirect_filter.hpp"

#include <algorithm>
#include <cmath>

namespace traygauge {
namespace {

constexpr float kTurnShare = 0.03F;  // 1 - cosine of 14° between normals: no weight beyond
constexpr float kPlaneShare = 4.0F;  // nor for a point this many pixels off the plane
constexpr float kNoSurface = 0.0F;   // nothing, or several

// A bell without exp: 1 at 0, 0 from 1 on.
float bell(float square) {
  const float rest = std::max(1.0F - square, 0.0F);
  return rest * rest;
}

}  // namespace

LightSmoother::LightSmoother(const SurfaceMap& map, std::span<const Eigen::Vector3f> light, float radius_px,
                             int first_row, int end_row)
    : map_(map),
      light_(light),
      reach_(static_cast<int>(std::ceil(radius_px))),
      top_(std::max(first_row - reach_, 0)),
      bottom_(std::min(end_row + reach_, map.height)),
      stride_(static_cast<std::size_t>(map.width + kLanes)),
      bell_stride_(static_cast<std::size_t>(2 * reach_ + 1 + kLanes)) {
  if (reach_ == 0) return;
  for (std::vector<float>& plane : planes_) plane.resize(static_cast<std::size_t>(bottom_ - top_) * stride_);
  for (int y = top_; y < bottom_; ++y) fill_row(y);
  bells_.resize(static_cast<std::size_t>(2 * reach_ + 1) * bell_stride_);
  for (int v = -reach_; v <= reach_; ++v) {
    for (int u = -reach_; u <= reach_; ++u) {
      bells_[static_cast<std::size_t>(v + reach_) * bell_stride_ + static_cast<std::size_t>(u + reach_)] =
          bell(static_cast<float>(u * u + v * v) / (radius_px * radius_px));
    }
  }
}

void LightSmoother::fill_row(int y) {
  for (int x = 0; x < map_.width; ++x) {
    const std::size_t from = map_.index(x, y);
    const std::size_t to = index(x, y);
    planes_[surface][to] = map_.is_mixed[from] != 0 ? kNoSurface : static_cast<float>(map_.objects[from]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto component = static_cast<Eigen::Index>(axis);
      planes_[normal_x + axis][to] = map_.normals[from][component];
      planes_[x_mm + axis][to] = map_.points_mm[from][component];
      planes_[red + axis][to] = light_[from][component];
    }
  }
}

Eigen::Vector3f LightSmoother::at(int x, int y) const {
  using Lanes = Eigen::Array<float, kLanes, 1>;
  const std::size_t from = map_.index(x, y);
  if (reach_ == 0 || map_.objects[from] == 0 || map_.is_mixed[from] != 0) return light_[from];
  const auto object = static_cast<float>(map_.objects[from]);
  const Eigen::Vector3f& normal = map_.normals[from];
  const Eigen::Vector3f& point_mm = map_.points_mm[from];
  const float per_plane_mm = 1.0F / (kPlaneShare * map_.footprint_mm[from]);
  const int first = std::max(x - reach_, 0);
  const int last = std::min(x + reach_, map_.width - 1);
  const auto of = [](const std::vector<float>& plane, std::size_t at) {
    return Eigen::Map<const Lanes>(plane.data() + at);
  };
  std::array<Lanes, 3> sums;
  for (Lanes& sum : sums) sum.setZero();
  Lanes weights = Lanes::Zero();
  for (int v = std::max(y - reach_, top_); v <= std::min(y + reach_, bottom_ - 1); ++v) {
    const std::size_t bells = static_cast<std::size_t>(v - y + reach_) * bell_stride_;
    for (int u = first; u <= last; u += kLanes) {
      const std::size_t there = index(u, v);
      // Objects are numbered: 1 for the same one, 0 for another.
      const Lanes is_like = (1.0F - (of(planes_[surface], there) - object).abs()).max(0.0F);
      const Lanes cosine = of(planes_[normal_x], there) * normal.x() +
                           of(planes_[normal_y], there) * normal.y() +
                           of(planes_[normal_z], there) * normal.z();
      const Lanes turn = (1.0F - cosine) / kTurnShare;
      const Lanes off = per_plane_mm * ((of(planes_[x_mm], there) - point_mm.x()) * normal.x() +
                                        (of(planes_[y_mm], there) - point_mm.y()) * normal.y() +
                                        (of(planes_[z_mm], there) - point_mm.z()) * normal.z());
      const Lanes evenness = (1.0F - turn * turn).max(0.0F) * (1.0F - off * off).max(0.0F);
      const Lanes weight =
          of(bells_, bells + static_cast<std::size_t>(u - x + reach_)) * is_like * evenness * evenness;
      for (std::size_t color = 0; color < 3; ++color) sums[color] += weight * of(planes_[red + color], there);
      weights += weight;
    }
  }
  Eigen::Vector4f total = Eigen::Vector4f::Zero();
  for (Eigen::Index lane = 0; lane < kLanes; ++lane)
    total += Eigen::Vector4f(sums[0][lane], sums[1][lane], sums[2][lane], weights[lane]);
  return total.head<3>() / total.w();
}

}  // namespace traygauge
