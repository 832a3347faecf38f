#include "firmware/api/shape_mesh.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace traygauge {
namespace {

void append_uint32(std::string& bytes, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xFFU);
}

void append_float(std::string& bytes, double value) {
  append_uint32(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

struct Mesh {
  std::string vertices;
  std::string faces;
  std::uint32_t vertex_count = 0;
  std::uint32_t face_count = 0;
};

void append_face(Mesh& mesh, const std::array<std::uint32_t, 3>& corners) {
  mesh.faces += static_cast<char>(corners.size());
  for (const std::uint32_t corner : corners) append_uint32(mesh.faces, corner);
  ++mesh.face_count;
}

void append_dish(const DishShape& dish, Mesh& mesh) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  constexpr double kMmPerTenth = 0.1;
  std::vector<std::uint32_t> vertex(dish.surface_tenth_mm.size(), kNone);
  for (int y = 0; y < dish.rows; ++y) {
    for (int x = 0; x < dish.columns; ++x) {
      const std::size_t cell = dish.index(x, y);
      if (!dish.surface_tenth_mm[cell]) continue;
      vertex[cell] = mesh.vertex_count++;
      append_float(mesh.vertices, dish.origin_x_mm + dish.cell_mm * x);
      append_float(mesh.vertices, dish.origin_y_mm + dish.cell_mm * y);
      append_float(mesh.vertices, kMmPerTenth * *dish.surface_tenth_mm[cell]);
      mesh.vertices += static_cast<char>(dish.labels[cell]);
    }
  }
  for (int y = 0; y + 1 < dish.rows; ++y) {
    for (int x = 0; x + 1 < dish.columns; ++x) {
      const std::uint32_t here = vertex[dish.index(x, y)];
      const std::uint32_t right = vertex[dish.index(x + 1, y)];
      const std::uint32_t away = vertex[dish.index(x, y + 1)];
      const std::uint32_t across = vertex[dish.index(x + 1, y + 1)];
      if (right == kNone || away == kNone) continue;
      if (here != kNone) append_face(mesh, {here, right, away});
      if (across != kNone) append_face(mesh, {right, across, away});
    }
  }
}

}  // namespace

std::string compose_shape_mesh(const ReadShape& shape) {
  Mesh mesh;
  for (const DishShape& dish : shape.dishes) append_dish(dish, mesh);
  return "ply\nformat binary_little_endian 1.0\ncomment Traygauge scan " + shape.id +
         ": mm, z up from the table\nelement vertex " + std::to_string(mesh.vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar label\nelement face " +
         std::to_string(mesh.face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" +
         mesh.vertices + mesh.faces;
}

}  // namespace traygauge
