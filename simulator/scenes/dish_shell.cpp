#include "simulator/scenes/dish_shell.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "simulator/scenes/mesh_tools.hpp"

namespace traygauge {
namespace {

constexpr double kWallMm = 4.0;        // of usual canteen porcelain
constexpr double kRingStepMm = 0.4;    // between rings of the inner surface
constexpr int kSegments = 384;         // around: chords within 0.005 mm of a plate's edge
constexpr double kFootWidthMm = 3.0;   // of the ring that the dish stands on
constexpr double kFootRecessMm = 1.0;  // height of the bottom within that ring
constexpr int kNewtonSteps = 40;

MonotoneCubic heights_of(const DishDescription& dish) {
  std::vector<double> inset;
  std::vector<double> height;
  for (const ProfilePoint& point : dish.profile) {
    inset.push_back(point.inset_mm);
    height.push_back(point.height_mm);
  }
  if (inset.empty()) return {{0.0}, {dish.bottom_height_mm}};
  return {std::move(inset), std::move(height)};
}

}  // namespace

DishShell::DishShell(const DishDescription& dish)
    : semi_x_mm_(0.5 * dish.outer_size_mm[0]),
      semi_y_mm_(0.5 * dish.outer_size_mm[1]),
      bottom_height_mm_(dish.bottom_height_mm),
      rim_height_mm_(dish.rim_height_mm),
      flat_inset_mm_(dish.profile.empty() ? 0.0 : dish.profile.back().inset_mm),
      height_mm_(heights_of(dish)) {}

double DishShell::inset_mm(double x_mm, double y_mm) const {
  const auto excess = [&](double inset) {
    const double x = x_mm / (semi_x_mm_ - inset);
    const double y = y_mm / (semi_y_mm_ - inset);
    return x * x + y * y - 1.0;
  };
  const double end = std::min(flat_inset_mm_, 0.999 * std::min(semi_x_mm_, semi_y_mm_));
  if (excess(end) <= 0.0) return flat_inset_mm_;
  // The excess rises with the inset and is convex: from the right Newton's steps never pass the root.
  double inset = end;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double x = semi_x_mm_ - inset;
    const double y = semi_y_mm_ - inset;
    const double rise = 2.0 * (x_mm * x_mm / (x * x * x) + y_mm * y_mm / (y * y * y));
    const double step = excess(inset) / rise;
    inset -= step;
    if (std::abs(step) < 1e-10) break;
  }
  return inset;
}

double DishShell::inner_height_mm(double x_mm, double y_mm) const {
  return height_mm_.value(inset_mm(x_mm, y_mm));
}

bool DishShell::contains(double x_mm, double y_mm, double margin_mm) const {
  const double x = x_mm / (semi_x_mm_ - margin_mm);
  const double y = y_mm / (semi_y_mm_ - margin_mm);
  return x * x + y * y < 1.0;
}

TriangleMesh DishShell::mesh() const {
  // The section from the middle of the inside over the edge to the middle of the underside: inset, height.
  std::vector<std::pair<double, double>> section;
  const int rings = std::max(2, static_cast<int>(std::ceil(flat_inset_mm_ / kRingStepMm)));
  for (int i = rings; i >= 0; --i) {
    const double inset = flat_inset_mm_ * i / rings;
    section.emplace_back(inset, height_mm_.value(inset));
  }
  const double edge_mm = section.back().second;
  section.emplace_back(0.0, std::max(edge_mm - 1.2, 0.5 * edge_mm));
  for (int i = 1; i <= rings; ++i) {
    const double inset = flat_inset_mm_ * i / rings;
    const double slope = height_mm_.slope(inset);
    const double length = std::hypot(1.0, slope);
    const double wall_mm = std::min(kWallMm, 0.9 * height_mm_.value(inset));
    const double below_mm = height_mm_.value(inset) - wall_mm / length;
    const double out_inset = std::max(inset + wall_mm * slope / length, section.back().first);
    section.emplace_back(out_inset, std::clamp(below_mm, kFootRecessMm, section.back().second));
  }
  const double foot_inset = std::max(section.back().first, flat_inset_mm_);
  for (const auto& [inset, height] : {std::pair{foot_inset, 0.0}, std::pair{foot_inset + kFootWidthMm, 0.0},
                                      std::pair{foot_inset + kFootWidthMm + 0.5, kFootRecessMm}}) {
    section.emplace_back(inset, height);
  }
  std::vector<std::vector<Eigen::Vector3f>> loops;
  for (const auto& [inset, height] : section) {
    std::vector<Eigen::Vector3f>& loop = loops.emplace_back();
    for (int i = 0; i < kSegments; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSegments;
      loop.emplace_back(Eigen::Vector3d((semi_x_mm_ - inset) * std::cos(angle),
                                        (semi_y_mm_ - inset) * std::sin(angle), height)
                            .cast<float>());
    }
  }
  TriangleMesh mesh = skin_of_loops(loops);
  add_smooth_normals(mesh);
  return mesh;
}

}  // namespace traygauge
