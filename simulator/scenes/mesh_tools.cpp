#include "simulator/scenes/mesh_tools.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace traygauge {
namespace {

Eigen::Vector3d vertex(const TriangleMesh& mesh, std::uint32_t index) {
  return mesh.vertices[index].cast<double>();
}

}  // namespace

TriangleMesh skin_of_loops(const std::vector<std::vector<Eigen::Vector3f>>& loops) {
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(loops.front().size());
  for (const auto& loop : loops) mesh.vertices.insert(mesh.vertices.end(), loop.begin(), loop.end());
  const auto rings = static_cast<std::uint32_t>(loops.size());
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t next = (i + 1) % count;
      const std::uint32_t here = ring * count;
      const std::uint32_t there = here + count;
      mesh.triangles.push_back({here + i, there + i, there + next});
      mesh.triangles.push_back({here + i, there + next, here + next});
    }
  }
  const auto close = [&](const std::vector<Eigen::Vector3f>& loop, std::uint32_t first, bool reversed) {
    const Eigen::Vector3f sum =
        std::accumulate(loop.begin(), loop.end(), Eigen::Vector3f(Eigen::Vector3f::Zero()));
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(sum / static_cast<float>(count));
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t next = (i + 1) % count;
      if (reversed) {
        mesh.triangles.push_back({first + next, first + i, middle});
      } else {
        mesh.triangles.push_back({first + i, first + next, middle});
      }
    }
  };
  close(loops.front(), 0, false);
  close(loops.back(), (rings - 1) * count, true);
  return mesh;
}

void add_smooth_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f normal =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    for (const std::uint32_t i : {a, b, c}) mesh.normals[i] += normal;
  }
  for (Eigen::Vector3f& normal : mesh.normals) {
    const float length = normal.norm();
    normal = length > 0.0F ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
  }
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
  for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({a + shift, b + shift, c + shift});
}

void transform(TriangleMesh& mesh, const Eigen::Isometry3d& placement) {
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex = (placement * vertex.cast<double>()).cast<float>();
  for (Eigen::Vector3f& normal : mesh.normals)
    normal = (placement.linear() * normal.cast<double>()).cast<float>();
}

TriangleMesh box_mesh(const Eigen::Vector3d& corner_mm, const Eigen::Vector3d& size_mm) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d share(i & 1, (i >> 1) & 1, i >> 2);
    mesh.vertices.emplace_back((corner_mm + share.cwiseProduct(size_mm)).cast<float>());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

bool is_closed(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> balance;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = triangle[i];
      const std::uint64_t to = triangle[(i + 1) % 3];
      if (from == to) return false;
      if (from < to) ++balance[(from << 32U) | to];
      if (to < from) --balance[(to << 32U) | from];
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

double enclosed_volume_mm3(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  const Eigen::Vector3d origin = mesh.vertices.front().cast<double>();  // near: less cancellation
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (vertex(mesh, a) - origin).dot((vertex(mesh, b) - origin).cross(vertex(mesh, c) - origin));
  return sum / 6.0;
}

}  // namespace traygauge
