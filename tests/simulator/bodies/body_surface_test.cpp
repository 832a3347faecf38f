#include "simulator/bodies/body_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "core/base/random.hpp"
#include "simulator/bodies/body_texture.hpp"
#include "simulator/capture/content_hash.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

// By the divergence theorem: a sixth of each triangle's product.
double volume_mm3(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& corners : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[corners[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices[corners[1]].cast<double>();
    const Eigen::Vector3d c = mesh.vertices[corners[2]].cast<double>();
    sum += a.dot(b.cross(c)) / 6.0;
  }
  return sum;
}

int gray_of_place(const ProofBody& body, int piece, const NetPoint& at) {
  const auto cell = [](double mm) { return static_cast<int>(std::floor(mm / kBodyCellMm)); };
  return body_cell_gray(body.id, piece, cell(at.x()), cell(at.y()));
}

// Whether rounding may put a place into the neighbouring square.
bool is_at_a_border(const NetPoint& at) {
  const auto off = [](double mm) { return std::abs(mm / kBodyCellMm - std::round(mm / kBodyCellMm)); };
  return off(at.x()) < 1e-6 || off(at.y()) < 1e-6;
}

TEST(BodySurface, MeshesAreClosedAndHaveTheClosedFormsVolume) {
  for (const ProofBody& body : proof_bodies()) {
    const TriangleMesh mesh = BodySurface(body).mesh();
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& corners : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) ++edges[{corners[i], corners[(i + 1) % 3]}];
    }
    for (const auto& [edge, uses] : edges) {
      EXPECT_EQ(uses, 1) << body.id;
      EXPECT_TRUE(edges.contains({edge.second, edge.first})) << body.id;
    }
    const double volume_ml = body_volume_ml(body.kind, body.size_mm);
    EXPECT_NEAR(1e-3 * volume_mm3(mesh) / volume_ml, 1.0, 1e-6) << body.id;
  }
}

// What the renderer shows at a place of a face is what is printed there.
TEST(BodySurface, FlatFacesShowTheirPrint) {
  Random random(test::random_seed());
  for (const ProofBody& body : proof_bodies()) {
    const BodySurface surface(body);
    const std::vector<NetPiece> pieces = unfold(body);
    for (const NetFace& face : pieces.front().faces) {
      if (face.corners_mm.empty()) continue;
      const Eigen::Vector3d normal = (face.corners_mm[1] - face.corners_mm[0])
                                         .cross(face.corners_mm[2] - face.corners_mm[0])
                                         .normalized();
      for (int i = 0; i < 200; ++i) {
        double u = random.uniform();
        double v = random.uniform();
        if (u + v > 1.0) {
          u = 1.0 - u;
          v = 1.0 - v;
        }
        const auto between = [&](const auto& corners) {
          return (corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0])).eval();
        };
        const NetPoint place = between(face.net);
        if (is_at_a_border(place)) continue;
        EXPECT_EQ(surface.gray_at(between(face.corners_mm), normal), gray_of_place(body, 0, place))
            << body.id;
      }
    }
    // The bottom is paper.
    EXPECT_EQ(surface.gray_at({1.0, 2.0, 0.0}, {0.0, 0.0, -1.0}), 235) << body.id;
  }
}

// The same for what is bent: a turn of the cone is a share of its ring's angle, a height a share of its
// width.
TEST(BodySurface, AConeShowsItsPrint) {
  Random random(test::random_seed());
  const ProofBody& body = *find_proof_body("T169");
  const BodySurface surface(body);
  const ConeSheet sheet = unroll_cone(body.size_mm);
  for (int i = 0; i < 500; ++i) {
    const double turn = 2.0 * std::numbers::pi * (random.uniform() - 0.5);
    const double up = random.uniform();
    const double radius = 0.5 * ((1.0 - up) * body.size_mm[0] + up * body.size_mm[1]);
    const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0.0);
    const Eigen::Vector3d normal = (out + 0.6 * Eigen::Vector3d::UnitZ()).normalized();
    const double direction = 0.5 * std::numbers::pi + turn * sheet.angle_rad / (2.0 * std::numbers::pi);
    const double reach = (1.0 - up) * sheet.outer_radius_mm + up * sheet.inner_radius_mm;
    const NetPoint place = reach * NetPoint(std::cos(direction), std::sin(direction));
    if (is_at_a_border(place)) continue;
    EXPECT_EQ(surface.gray_at(radius * out + up * body.size_mm[2] * Eigen::Vector3d::UnitZ(), normal),
              gray_of_place(body, 0, place));
  }
  const Eigen::Vector3d on_top(3.3, -4.7, body.size_mm[2]);
  EXPECT_EQ(surface.gray_at(on_top, Eigen::Vector3d::UnitZ()), gray_of_place(body, 1, on_top.head<2>()));
}

TEST(BodyTexture, MostSquaresDifferFromTheirNeighbours) {
  for (const ProofBody& body : proof_bodies()) {
    int corners = 0;
    constexpr int kSide = 40;
    std::set<int> grays;
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const int own = body_cell_gray(body.id, 0, column, row);
        grays.insert(own);
        const bool is_corner = own != body_cell_gray(body.id, 0, column + 1, row) &&
                               own != body_cell_gray(body.id, 0, column, row + 1);
        corners += is_corner ? 1 : 0;
      }
    }
    // Of five greys that were equally frequent it were 64 %.
    EXPECT_GT(corners, kSide * kSide * 45 / 100) << body.id;
    EXPECT_EQ(grays.size(), 5U) << body.id;
  }
}

// Bodies outlive programs: their print never changes.
TEST(BodyTexture, StaysTheSameForEver) {
  std::string all;
  for (const ProofBody& body : proof_bodies()) {
    for (int piece = 0; piece < 2; ++piece) {
      for (int row = -30; row < 30; ++row) {
        for (int column = -30; column < 30; ++column)
          all += static_cast<char>(body_cell_gray(body.id, piece, column, row));
      }
    }
  }
  EXPECT_EQ(content_hash(all), "8c7fa7506dc77a66");
}

}  // namespace
}  // namespace traygauge
