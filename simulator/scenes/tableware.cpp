#include "simulator/scenes/tableware.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/monotone_cubic.hpp"

namespace traygauge {
namespace {

using Loop = std::vector<Eigen::Vector3f>;

constexpr int kCornerSteps = 12;  // around a quarter of a corner

// A rectangle with rounded corners, counter-clockwise from above.
Loop rounded_rectangle(double half_x, double half_y, double radius, double z) {
  Loop loop;
  const double r = std::max(radius, 0.5);
  for (int corner = 0; corner < 4; ++corner) {
    const double x = corner == 0 || corner == 3 ? half_x - r : r - half_x;
    const double y = corner < 2 ? half_y - r : r - half_y;
    for (int i = 0; i <= kCornerSteps; ++i) {
      const double angle = 0.5 * std::numbers::pi * (corner + static_cast<double>(i) / kCornerSteps);
      loop.push_back(Eigen::Vector3d(x + r * std::cos(angle), y + r * std::sin(angle), z).cast<float>());
    }
  }
  return loop;
}

// Half the width and the height of the middle at a share of the length.
struct Section {
  double along = 0.0;
  double half_width_mm = 0.0;
  double rise_mm = 0.0;
};

constexpr std::array kHandle = std::to_array<Section>(
    {{0.0, 5.0, 1.5}, {0.02, 8.5, 1.5}, {0.1, 9.0, 2.0}, {0.3, 7.0, 3.5}, {0.5, 4.0, 5.0}});
constexpr std::array kSpoonBowl = std::to_array<Section>({{0.62, 3.6, 6.0},
                                                          {0.68, 6.0, 4.0},
                                                          {0.74, 15.0, 2.0},
                                                          {0.82, 21.0, 1.6},
                                                          {0.92, 18.0, 2.6},
                                                          {1.0, 3.0, 4.0}});
constexpr std::array kForkHead =
    std::to_array<Section>({{0.62, 3.6, 6.0}, {0.68, 7.0, 4.0}, {0.74, 12.5, 2.2}, {0.78, 12.5, 1.8}});
constexpr std::array kKnifeBlade = std::to_array<Section>(
    {{0.52, 5.0, 3.0}, {0.56, 9.0, 2.0}, {0.8, 10.0, 2.0}, {0.95, 8.0, 2.0}, {1.0, 2.0, 2.0}});

// A flat bar with elliptic sections; a spoon's bowl is hollowed by raising its borders.
TriangleMesh bar(std::span<const Section> sections, double length_mm, double thickness_mm, double hollow_mm) {
  constexpr int kAround = 24;
  constexpr int kAlong = 60;
  std::vector<double> along;
  std::vector<double> half_width_mm;
  std::vector<double> rise_mm;
  for (const Section& section : sections) {
    along.push_back(section.along);
    half_width_mm.push_back(section.half_width_mm);
    rise_mm.push_back(section.rise_mm);
  }
  const MonotoneCubic width(along, half_width_mm);
  const MonotoneCubic rise(along, rise_mm);
  std::vector<Loop> loops;
  for (int step = 0; step <= kAlong; ++step) {
    const double share_along = along.front() + (along.back() - along.front()) * step / kAlong;
    const Section section{share_along, width.value(share_along), rise.value(share_along)};
    Loop loop;
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      const double across = section.half_width_mm * std::cos(angle);
      const double share = std::cos(angle) * std::cos(angle);
      const double hollow = hollow_mm * share * std::clamp((section.half_width_mm - 8.0) / 10.0, 0.0, 1.0);
      loop.push_back(Eigen::Vector3d((section.along - 0.5) * length_mm, across,
                                     section.rise_mm + hollow + 0.5 * thickness_mm * std::sin(angle))
                         .cast<float>());
    }
    loops.push_back(std::move(loop));
  }
  std::reverse(loops.begin(), loops.end());
  TriangleMesh mesh = skin_of_loops(loops);
  add_smooth_normals(mesh);
  return mesh;
}

std::vector<Section> joined(std::span<const Section> handle, std::span<const Section> head) {
  std::vector<Section> sections(handle.begin(), handle.end());
  sections.insert(sections.end(), head.begin(), head.end());
  return sections;
}

TriangleMesh fork_mesh() {
  constexpr double kLengthMm = 195.0;
  TriangleMesh mesh = bar(joined(kHandle, kForkHead), kLengthMm, 2.4, 2.0);
  for (int tine = 0; tine < 4; ++tine) {
    constexpr std::array kTine =
        std::to_array<Section>({{0.77, 1.6, 2.0}, {0.88, 1.5, 2.4}, {1.0, 0.7, 5.0}});
    TriangleMesh prong = bar(kTine, kLengthMm, 2.0, 0.0);
    transform(prong, Eigen::Isometry3d(Eigen::Translation3d(0.0, 7.0 * (tine - 1.5), 0.0)));
    append(mesh, prong);
  }
  return mesh;
}

// Folded paper: two layers, the upper one shifted.
TriangleMesh napkin_mesh() {
  TriangleMesh mesh = box_mesh({-82.0, -80.0, 0.0}, {164.0, 160.0, 0.6});
  append(mesh, box_mesh({-80.5, -80.0, 0.6}, {161.0, 158.0, 0.6}));
  return mesh;
}

}  // namespace

TriangleMesh tray_mesh(const Tray& tray) {
  struct Step {
    double inset_mm;
    double z_mm;
  };
  constexpr double kLipMm = 12.0;
  constexpr double kRadiusMm = 45.0;
  constexpr std::array kSteps = std::to_array<Step>({{17.0, 0.0},
                                                     {14.0, 0.4},
                                                     {11.0, 2.2},
                                                     {6.0, 8.0},
                                                     {3.5, 11.0},
                                                     {2.0, kLipMm},
                                                     {0.8, kLipMm},
                                                     {0.0, kLipMm - 1.5},
                                                     {0.6, 9.0},
                                                     {14.0, -kTrayFloorMm}});
  std::vector<Loop> loops;
  loops.reserve(kSteps.size());
  for (const Step& step : kSteps) {
    loops.push_back(rounded_rectangle(0.5 * tray.size_mm[0] - step.inset_mm,
                                      0.5 * tray.size_mm[1] - step.inset_mm, kRadiusMm - step.inset_mm,
                                      step.z_mm));
  }
  TriangleMesh mesh = skin_of_loops(loops);
  add_smooth_normals(mesh);
  return mesh;
}

TriangleMesh utensil_mesh(UtensilKind kind) {
  switch (kind) {
    case UtensilKind::fork:
      return fork_mesh();
    case UtensilKind::knife:
      return bar(joined(kHandle, kKnifeBlade), 210.0, 3.0, 0.0);
    case UtensilKind::spoon:
      return bar(joined(kHandle, kSpoonBowl), 195.0, 2.6, 5.0);
    case UtensilKind::napkin:
      break;
  }
  return napkin_mesh();
}

}  // namespace traygauge
