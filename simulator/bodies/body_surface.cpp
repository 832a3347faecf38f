#include "simulator/bodies/body_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "simulator/bodies/body_texture.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kPaperGray = 235;
constexpr std::uint32_t kConeSides = 256;

// A polygon that bends nowhere inward, as a fan.
void add_fan(TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& corners_mm) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3d& corner : corners_mm) {
    const Eigen::Vector3f at = corner.cast<float>();
    mesh.vertices.push_back(at);
  }
  for (std::uint32_t i = 2; i < corners_mm.size(); ++i)
    mesh.triangles.push_back({first, first + i - 1, first + i});
}

// Faces that meet share their corners, as a closed mesh has to.
void merge_corners(TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> unique;
  std::vector<std::uint32_t> number_of;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    const auto found = std::ranges::find(unique, vertex);
    number_of.push_back(static_cast<std::uint32_t>(found - unique.begin()));
    if (found == unique.end()) unique.push_back(vertex);
  }
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = number_of[corner];
  }
  mesh.vertices = std::move(unique);
}

}  // namespace

BodySurface::BodySurface(const ProofBody& body) : body_(body), id_(body.id), pieces_(unfold(body)) {
  if (body.kind == BodyKind::cone) {
    cone_ = unroll_cone(body.size_mm);
    return;
  }
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    for (const NetFace& face : pieces_[piece].faces) {
      Facet facet;
      facet.piece = static_cast<int>(piece);
      facet.is_textured = pieces_[piece].is_textured;
      facet.origin_mm = face.corners_mm[0];
      facet.net_origin = face.net[0];
      const Eigen::Vector3d first = face.corners_mm[1] - face.corners_mm[0];
      facet.normal = first.cross(face.corners_mm[2] - face.corners_mm[0]).normalized();
      const Eigen::Vector3d along = first.normalized();
      const NetPoint net_along = (face.net[1] - face.net[0]).normalized();
      const NetPoint net_across(-net_along.y(), net_along.x());
      facet.net_from_body =
          net_along * along.transpose() + net_across * facet.normal.cross(along).transpose();
      facets_.push_back(facet);
    }
  }
}

TriangleMesh BodySurface::mesh() const {
  if (body_.kind == BodyKind::cone) return cone_mesh();
  TriangleMesh mesh;
  for (const NetPiece& piece : pieces_) {
    for (const NetFace& face : piece.faces) add_fan(mesh, face.corners_mm);
  }
  merge_corners(mesh);
  return mesh;
}

// Its circles are polygons of the same area, so that the volume is that of the round cone.
TriangleMesh BodySurface::cone_mesh() const {
  const double step = 2.0 * std::numbers::pi / kConeSides;
  const double widening = std::sqrt(step / std::sin(step));
  TriangleMesh mesh;
  for (const auto& [diameter, height] :
       {std::pair{body_.size_mm[0], 0.0}, std::pair{body_.size_mm[1], body_.size_mm[2]}}) {
    for (std::uint32_t i = 0; i < kConeSides; ++i) {
      const double radius = 0.5 * diameter * widening;
      mesh.vertices.emplace_back(
          Eigen::Vector3d(radius * std::cos(i * step), radius * std::sin(i * step), height).cast<float>());
    }
  }
  for (std::uint32_t i = 0; i < kConeSides; ++i) {
    const std::uint32_t next = (i + 1) % kConeSides;
    mesh.triangles.push_back({i, next, kConeSides + next});
    mesh.triangles.push_back({i, kConeSides + next, kConeSides + i});
  }
  for (std::uint32_t i = 2; i < kConeSides; ++i) {
    mesh.triangles.push_back({0, i, i - 1});
    mesh.triangles.push_back({kConeSides, kConeSides + i - 1, kConeSides + i});
  }
  return mesh;
}

std::uint8_t BodySurface::gray_of(int piece, const NetPoint& place) const {
  const auto cell = [](double at) { return static_cast<int>(std::floor(at / kBodyCellMm)); };
  return body_cell_gray(id_, piece, cell(place.x()), cell(place.y()));
}

std::uint8_t BodySurface::gray_of_cone(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal) const {
  constexpr double kUpright = 0.95;  // of no side of a cone that people can fold
  if (normal.z() > kUpright) return gray_of(1, point_mm.head<2>());
  if (normal.z() < -kUpright) return kPaperGray;
  const double up = point_mm.z() / body_.size_mm[2];
  const double radius = cone_.outer_radius_mm - up * (cone_.outer_radius_mm - cone_.inner_radius_mm);
  const double turn = std::atan2(point_mm.y(), point_mm.x());
  const double angle = 0.5 * std::numbers::pi + turn / (2.0 * std::numbers::pi) * cone_.angle_rad;
  return gray_of(0, radius * NetPoint(std::cos(angle), std::sin(angle)));
}

std::uint8_t BodySurface::gray_at(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal) const {
  if (facets_.empty()) return gray_of_cone(point_mm, normal);
  const auto facet = std::ranges::max_element(
      facets_, {}, [&](const Facet& candidate) { return candidate.normal.dot(normal); });
  if (!facet->is_textured) return kPaperGray;
  return gray_of(facet->piece, facet->net_origin + facet->net_from_body * (point_mm - facet->origin_mm));
}

}  // namespace traygauge
