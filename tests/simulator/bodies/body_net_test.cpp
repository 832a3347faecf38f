// That what is printed folds to the body.
#include "simulator/bodies/body_net.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/base/random.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kSameMm = 1e-9;

double length_of(const NetPolygon& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

bool contains(const NetPolygon& polygon, const NetPoint& at) {
  bool is_inside = false;
  for (std::size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++) {
    const NetPoint& a = polygon[i];
    const NetPoint& b = polygon[k];
    if ((a.y() > at.y()) == (b.y() > at.y())) continue;
    if (at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) is_inside = !is_inside;
  }
  return is_inside;
}

TEST(BodyNet, FacesKeepTheirShapeOnTheSheet) {
  for (const ProofBody& body : proof_bodies()) {
    for (const NetPiece& piece : unfold(body)) {
      for (const NetFace& face : piece.faces) {
        for (std::size_t i = 0; i < face.corners_mm.size(); ++i) {
          for (std::size_t k = 0; k < i; ++k) {
            EXPECT_NEAR((face.net[i] - face.net[k]).norm(), (face.corners_mm[i] - face.corners_mm[k]).norm(),
                        kSameMm)
                << body.id;
          }
        }
      }
    }
  }
}

// Each edge of the solid is that of two faces; printed, it is a fold, or a cut with one tab.
TEST(BodyNet, EdgesMeetTheirLikes) {
  for (const ProofBody& body : proof_bodies()) {
    if (body.kind == BodyKind::cone) continue;
    std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> edges;
    const auto key = [](const Eigen::Vector3d& at) { return std::array{at.x(), at.y(), at.z()}; };
    const std::vector<NetPiece> pieces = unfold(body);
    std::size_t count = 0;
    for (const NetPiece& piece : pieces) {
      for (const NetFace& face : piece.faces) {
        for (std::size_t i = 0; i < face.corners_mm.size(); ++i, ++count)
          ++edges[{key(face.corners_mm[i]), key(face.corners_mm[(i + 1) % face.corners_mm.size()])}];
      }
    }
    for (const auto& [edge, uses] : edges) {
      EXPECT_EQ(uses, 1) << body.id;
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1U) << body.id;
    }
    const NetPiece& shell = pieces.front();
    EXPECT_EQ(2 * (shell.folds.size() + shell.tabs.size()), count) << body.id;
    EXPECT_EQ(shell.folds.size(), shell.faces.size() - 1) << body.id;
  }
}

TEST(BodyNet, FoldsAreEdgesOfBothFaces) {
  for (const ProofBody& body : proof_bodies()) {
    const NetPiece shell = unfold(body).front();
    for (const NetLine& fold : shell.folds) {
      int uses = 0;
      for (const NetFace& face : shell.faces) {
        for (std::size_t i = 0; i < face.net.size(); ++i) {
          const NetPoint& from = face.net[i];
          const NetPoint& to = face.net[(i + 1) % face.net.size()];
          const bool is_same = (from - fold[0]).norm() + (to - fold[1]).norm() < kSameMm;
          const bool is_reverse = (from - fold[1]).norm() + (to - fold[0]).norm() < kSameMm;
          if (is_same || is_reverse) ++uses;
        }
      }
      EXPECT_EQ(uses, 2) << body.id;
    }
  }
}

TEST(BodyNet, AConesRingRollsUpToItsCircles) {
  for (const ProofBody& body : proof_bodies()) {
    if (body.kind != BodyKind::cone) continue;
    const ConeSheet sheet = unroll_cone(body.size_mm);
    EXPECT_NEAR(sheet.angle_rad * sheet.outer_radius_mm, std::numbers::pi * body.size_mm[0], kSameMm);
    EXPECT_NEAR(sheet.angle_rad * sheet.inner_radius_mm, std::numbers::pi * body.size_mm[1], kSameMm);
    EXPECT_NEAR(sheet.outer_radius_mm - sheet.inner_radius_mm,
                std::hypot(0.5 * (body.size_mm[0] - body.size_mm[1]), body.size_mm[2]), kSameMm);
    // As it is drawn: both arcs and both ends of the ring.
    NetPolygon outline = unfold(body).front().faces.front().net;
    outline.push_back(outline.front());
    EXPECT_NEAR(length_of(outline),
                std::numbers::pi * (body.size_mm[0] + body.size_mm[1]) +
                    2.0 * (sheet.outer_radius_mm - sheet.inner_radius_mm),
                0.01);
    for (const NetPiece& piece : unfold(body)) {
      if (piece.name == "shell") continue;
      const double diameter = piece.name == "top" ? body.size_mm[1] : body.size_mm[0];
      EXPECT_NEAR(length_of(piece.cuts.front()), std::numbers::pi * diameter, 0.01) << piece.name;
    }
  }
}

// Paper is there once: no two faces or tabs of a piece share a place.
TEST(BodyNet, NothingOverlapsOnTheSheet) {
  Random random(test::random_seed());
  for (const ProofBody& body : proof_bodies()) {
    for (const NetPiece& piece : unfold(body)) {
      std::vector<NetPolygon> parts;
      for (const NetFace& face : piece.faces) parts.push_back(face.net);
      // A tab's fold is a chord of an arc, which lies up to 0.15 mm inside of it.
      for (const GlueTab& tab : piece.tabs) {
        const double inset = body.kind == BodyKind::cone ? 0.05 : 0.0;
        parts.push_back(
            {tab[0] + inset * (tab[3] - tab[0]), tab[1] + inset * (tab[2] - tab[1]), tab[2], tab[3]});
      }
      int hits = 0;
      for (int i = 0; i < 20000; ++i) {
        const NetPoint at(400.0 * random.uniform() - 200.0, 400.0 * random.uniform() - 200.0);
        int holders = 0;
        for (const NetPolygon& part : parts) holders += contains(part, at) ? 1 : 0;
        hits += holders;
        EXPECT_LE(holders, 1) << body.id << " " << piece.name << " at " << at.transpose();
      }
      EXPECT_GT(hits, 50) << body.id;
    }
  }
}

}  // namespace
}  // namespace traygauge
