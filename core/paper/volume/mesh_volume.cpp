#include "core/paper/volume/mesh_volume.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"

namespace traygauge::paper {
namespace {

// Area of the triangle's shadow on the plane.
double horizontal_area(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& up) {
  return std::abs(0.5 * up.dot((b - a).cross(c - a)));
}

void add_triangles(const FoodMesh& mesh, const Plane& dish_bottom, std::span<ItemVolume> items) {
  for (const MeshTriangle& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t k) -> const Vec3& {
      return mesh.points[static_cast<std::size_t>(triangle.corners[k])].position_mm;
    };
    const double area = horizontal_area(corner(0), corner(1), corner(2), dish_bottom.normal);
    const double heights =
        dish_bottom.height(corner(0)) + dish_bottom.height(corner(1)) + dish_bottom.height(corner(2));
    ItemVolume& item = items[triangle.label];
    item.label = triangle.label;
    item.area_mm2 += area;
    item.volume_ml += area * heights / (3.0 * kMm3PerMl);
  }
}

// Sorts the heights by label into `heights_mm` and takes each label's quantile.
void measure_max_heights(const FoodMesh& mesh, const Plane& dish_bottom, double quantile,
                         VolumeWorkspace& workspace) {
  std::array<std::uint32_t, 257> begin{};
  for (const MeshPoint& point : mesh.points) ++begin[point.label + 1U];
  for (std::size_t label = 0; label < 256; ++label) begin[label + 1] += begin[label];
  std::array<std::uint32_t, 257> next = begin;
  for (const MeshPoint& point : mesh.points) {
    workspace.heights_mm[next[point.label]++] = static_cast<float>(dish_bottom.height(point.position_mm));
  }
  for (std::size_t label = 0; label < 256; ++label) {
    const std::uint32_t count = begin[label + 1] - begin[label];
    if (count == 0) continue;
    const std::span<float> heights = workspace.heights_mm.subspan(begin[label], count);
    const auto place = heights.begin() + static_cast<std::ptrdiff_t>(quantile * (count - 1) + 0.5);
    std::nth_element(heights.begin(), place, heights.end());
    workspace.items[label].max_height_mm = static_cast<double>(*place);
  }
}

}  // namespace

Status integrate_volume(const FoodMesh& mesh, const Plane& dish_bottom, const VolumeParams& params,
                        VolumeWorkspace& workspace) {
  std::fill(workspace.items.begin(), workspace.items.end(), ItemVolume{});
  if (mesh.triangles.empty()) return StatusCode::too_little_depth;
  if (mesh.points.size() > workspace.heights_mm.size()) return StatusCode::out_of_memory;
  add_triangles(mesh, dish_bottom, workspace.items);
  measure_max_heights(mesh, dish_bottom, params.max_height_quantile, workspace);
  for (ItemVolume& item : workspace.items) {
    if (item.area_mm2 > 0.0) item.mean_height_mm = item.volume_ml * kMm3PerMl / item.area_mm2;
  }
  return StatusCode::ok;
}

}  // namespace traygauge::paper
