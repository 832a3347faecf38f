#include "simulator/scenes/height_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace traygauge {
namespace {

constexpr float kMinHeightMm = 0.02F;  // thinner food would leave its upper side on the dish
constexpr double kOnWallMm = 0.05;

// Node of the grid, or a point on the edge between two of them where the footprint ends.
class SurfaceMesher {
 public:
  SurfaceMesher(const HeightField& field, const GroundHeight& base, const GroundHeight& dish, double plane_mm)
      : field_(field), base_(base), dish_(dish), plane_mm_(plane_mm) {}

  FoodSolid make() {
    const GridFrame& frame = field_.frame;
    for (int row = 0; row + 1 < frame.rows; ++row) {
      for (int column = 0; column + 1 < frame.columns; ++column) {
        const auto a = static_cast<std::uint32_t>(frame.index(column, row));
        const auto b = static_cast<std::uint32_t>(frame.index(column + 1, row));
        const auto c = static_cast<std::uint32_t>(frame.index(column + 1, row + 1));
        const auto d = static_cast<std::uint32_t>(frame.index(column, row + 1));
        if ((column + row) % 2 == 0) {
          add({a, b, c});
          add({a, c, d});
        } else {
          add({a, b, d});
          add({b, c, d});
        }
      }
    }
    finish();
    return std::move(solid_);
  }

 private:
  using Triangle = std::array<std::uint32_t, 3>;

  bool is_inside(std::uint32_t node) const { return field_.inside_mm[node] > 0.0F; }

  Eigen::Vector2d place(std::uint32_t node) const {
    const auto columns = static_cast<std::uint32_t>(field_.frame.columns);
    return field_.frame.node(static_cast<int>(node % columns), static_cast<int>(node / columns));
  }

  std::uint32_t add_vertex(const Eigen::Vector2d& at, float height_mm) {
    const double dish_mm = dish_(at.x(), at.y());
    const double top_mm = std::max(base_(at.x(), at.y()) + static_cast<double>(std::max(height_mm, 0.0F)),
                                   dish_mm + static_cast<double>(kMinHeightMm));
    top_.emplace_back(at.x(), at.y(), top_mm);
    dish_height_.push_back(dish_mm);
    return static_cast<std::uint32_t>(top_.size() - 1);
  }

  std::uint32_t vertex_at(std::uint32_t node) {
    const auto [found, is_new] = at_node_.try_emplace(node, 0);
    if (is_new) found->second = add_vertex(place(node), field_.height_mm[node]);
    return found->second;
  }

  std::uint32_t vertex_between(std::uint32_t in, std::uint32_t out) {
    const std::uint64_t key = (static_cast<std::uint64_t>(std::min(in, out)) << 32U) | std::max(in, out);
    const auto [found, is_new] = at_border_.try_emplace(key, 0);
    if (is_new) {
      const float share = field_.inside_mm[in] / (field_.inside_mm[in] - field_.inside_mm[out]);
      const float kept = std::clamp(share, 0.02F, 0.98F);  // no needles
      const Eigen::Vector2d at = place(in) + static_cast<double>(kept) * (place(out) - place(in));
      found->second =
          add_vertex(at, field_.height_mm[in] + kept * (field_.height_mm[out] - field_.height_mm[in]));
    }
    return found->second;
  }

  void emit(const Triangle& triangle) { triangles_.push_back(triangle); }

  void add(const Triangle& nodes) {
    const auto count = std::ranges::count_if(nodes, [this](std::uint32_t node) { return is_inside(node); });
    if (count == 0) return;
    if (count == 3) return emit({vertex_at(nodes[0]), vertex_at(nodes[1]), vertex_at(nodes[2])});
    // Turned so that the odd one out comes first.
    std::size_t odd = 0;
    while (is_inside(nodes[odd]) != (count == 1)) ++odd;
    const std::uint32_t a = nodes[odd];
    const std::uint32_t b = nodes[(odd + 1) % 3];
    const std::uint32_t c = nodes[(odd + 2) % 3];
    if (count == 1) {
      const std::uint32_t ab = vertex_between(a, b);
      const std::uint32_t ac = vertex_between(a, c);
      emit({vertex_at(a), ab, ac});
      walls_.push_back({ab, ac});
      return;
    }
    const std::uint32_t ab = vertex_between(b, a);
    const std::uint32_t ac = vertex_between(c, a);
    emit({ab, vertex_at(b), vertex_at(c)});
    emit({ab, vertex_at(c), ac});
    walls_.push_back({ac, ab});
  }

  void sum_up(const Triangle& triangle) {
    const Eigen::Vector3d& a = top_[triangle[0]];
    const Eigen::Vector3d& b = top_[triangle[1]];
    const Eigen::Vector3d& c = top_[triangle[2]];
    const double area = 0.5 * ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()));
    const double dish_mm =
        (dish_height_[triangle[0]] + dish_height_[triangle[1]] + dish_height_[triangle[2]]) / 3.0;
    solid_.footprint_mm2 += area;
    if (dish_mm > plane_mm_ + kOnWallMm) solid_.on_wall_mm2 += area;
    solid_.above_plane_mm3 += area * ((a.z() + b.z() + c.z()) / 3.0 - plane_mm_);
    solid_.centre_mm += area * (a + b + c).head<2>() / 3.0;
  }

  void finish() {
    TriangleMesh& mesh = solid_.mesh;
    for (const Eigen::Vector3d& vertex : top_) mesh.vertices.emplace_back(vertex.cast<float>());
    mesh.triangles = triangles_;
    add_top_normals();
    const auto count = static_cast<std::uint32_t>(top_.size());
    add_lower_sides(count);
    for (const Triangle& triangle : triangles_) sum_up(triangle);
    if (solid_.footprint_mm2 > 0.0) solid_.centre_mm /= solid_.footprint_mm2;
    for (std::size_t i = 0; i < top_.size(); ++i)
      solid_.max_height_mm = std::max(solid_.max_height_mm, top_[i].z() - dish_height_[i]);
    solid_.volume_mm3 = divergence_mm3();
  }

  void add_top_normals() {
    TriangleMesh& mesh = solid_.mesh;
    mesh.normals.assign(mesh.vertices.size(), Eigen::Vector3f::Zero());
    for (const auto& [a, b, c] : triangles_) {
      const Eigen::Vector3f normal =
          (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
      for (const std::uint32_t i : {a, b, c}) mesh.normals[i] += normal;
    }
    for (Eigen::Vector3f& normal : mesh.normals) normal.normalize();
  }

  // Lower side and walls have vertices of their own: their normals are others.
  void add_lower_sides(std::uint32_t count) {
    TriangleMesh& mesh = solid_.mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
      mesh.vertices.emplace_back(static_cast<float>(top_[i].x()), static_cast<float>(top_[i].y()),
                                 static_cast<float>(dish_height_[i]));
      mesh.normals.emplace_back(0.0F, 0.0F, -1.0F);
    }
    for (const auto& [a, b, c] : triangles_) mesh.triangles.push_back({c + count, b + count, a + count});
    for (const auto& [from, to] : walls_) {
      const Eigen::Vector3f along = mesh.vertices[to] - mesh.vertices[from];
      const Eigen::Vector3f out = Eigen::Vector3f(along.y(), -along.x(), 0.0F).normalized();
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const std::uint32_t vertex : {from, to, from + count, to + count}) {
        mesh.vertices.emplace_back(Eigen::Vector3f(mesh.vertices[vertex]));
        mesh.normals.push_back(out);
      }
      mesh.triangles.push_back({first, first + 2, first + 3});
      mesh.triangles.push_back({first, first + 3, first + 1});
    }
  }

  // Over the closed surface, in double: the vertices of the mesh are floats.
  double divergence_mm3() const {
    const auto corner = [&](std::uint32_t vertex, bool is_top) {
      return is_top ? top_[vertex]
                    : Eigen::Vector3d(top_[vertex].x(), top_[vertex].y(), dish_height_[vertex]);
    };
    const auto sixfold = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
      return a.dot(b.cross(c));
    };
    double sum = 0.0;
    for (const auto& [a, b, c] : triangles_) {
      sum += sixfold(corner(a, true), corner(b, true), corner(c, true));
      sum -= sixfold(corner(a, false), corner(b, false), corner(c, false));
    }
    for (const auto& [from, to] : walls_) {
      sum += sixfold(corner(from, true), corner(from, false), corner(to, false));
      sum += sixfold(corner(from, true), corner(to, false), corner(to, true));
    }
    return sum / 6.0;
  }

  const HeightField& field_;
  const GroundHeight& base_;
  const GroundHeight& dish_;
  double plane_mm_;
  FoodSolid solid_;
  std::vector<Eigen::Vector3d> top_;
  std::vector<double> dish_height_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<std::uint32_t, 2>> walls_;  // footprint to the left of from → to
  std::unordered_map<std::uint32_t, std::uint32_t> at_node_;
  std::unordered_map<std::uint64_t, std::uint32_t> at_border_;
};

}  // namespace

FoodSolid mesh_of_field(const HeightField& field, const GroundHeight& base, const GroundHeight& dish,
                        double plane_height_mm) {
  return SurfaceMesher(field, base, dish, plane_height_mm).make();
}

}  // namespace traygauge
