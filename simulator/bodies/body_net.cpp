#include "simulator/bodies/body_net.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace traygauge {
namespace {

constexpr double kTabMm = 7.0;
constexpr double kToothMm = 9.0;    // of a round edge's tabs, along it
constexpr double kArcStepMm = 0.5;  // chords are within 0.001 mm of their arcs
constexpr int kRoot = -1;

// Corners by number, counter-clockwise seen from outside, and the face from which a face is folded away.
struct SolidFace {
  std::vector<std::size_t> corners;
  int parent = kRoot;
};

// The last face is the bottom.
struct Solid {
  std::vector<Eigen::Vector3d> corners_mm;
  std::vector<SolidFace> faces;
};

Solid solid_of(BodyKind kind, const BodySize& size_mm) {
  const double x = 0.5 * size_mm[0];
  const double y = 0.5 * size_mm[1];
  const double height = size_mm[2];
  Solid solid;
  solid.corners_mm = {{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}};
  if (kind == BodyKind::cuboid) {
    for (std::size_t i = 0; i < 4; ++i)
      solid.corners_mm.emplace_back(solid.corners_mm[i] + height * Eigen::Vector3d::UnitZ());
    solid.faces = {{{4, 5, 6, 7}, kRoot}, {{0, 1, 5, 4}, 0}, {{1, 2, 6, 5}, 0},
                   {{2, 3, 7, 6}, 0},     {{3, 0, 4, 7}, 0}, {{3, 2, 1, 0}, kRoot}};
  } else if (kind == BodyKind::pyramid) {
    solid.corners_mm.emplace_back(0.0, 0.0, height);
    solid.faces = {{{0, 1, 4}, kRoot}, {{1, 2, 4}, 0}, {{2, 3, 4}, 1}, {{3, 0, 4}, 2}, {{3, 2, 1, 0}, kRoot}};
  } else {
    solid.corners_mm.emplace_back(-x, 0.0, height);
    solid.corners_mm.emplace_back(x, 0.0, height);
    solid.faces = {
        {{0, 1, 5, 4}, kRoot}, {{2, 3, 4, 5}, 0}, {{3, 0, 4}, 0}, {{1, 2, 5}, 0}, {{3, 2, 1, 0}, kRoot}};
  }
  return solid;
}

// The edge from one corner to the other, in a face.
std::optional<std::size_t> find_edge(const SolidFace& face, std::size_t from, std::size_t to) {
  const std::size_t count = face.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (face.corners[i] == from && face.corners[(i + 1) % count] == to) return i;
  }
  return std::nullopt;
}

NetPoint left_of(const NetPoint& direction) {
  return {-direction.y(), direction.x()};
}

// Lays a face on the sheet so that its edge comes to lie from `from` to `to`.
NetFace lay(const Solid& solid, const SolidFace& face, std::size_t edge, const NetPoint& from,
            const NetPoint& to) {
  NetFace laid;
  for (const std::size_t corner : face.corners) laid.corners_mm.push_back(solid.corners_mm[corner]);
  const std::size_t count = laid.corners_mm.size();
  const Eigen::Vector3d origin = laid.corners_mm[edge];
  const Eigen::Vector3d along = (laid.corners_mm[(edge + 1) % count] - origin).normalized();
  const Eigen::Vector3d normal =
      (laid.corners_mm[1] - laid.corners_mm[0]).cross(laid.corners_mm[2] - laid.corners_mm[1]).normalized();
  const Eigen::Vector3d inward = normal.cross(along);
  const NetPoint net_along = (to - from).normalized();
  for (const Eigen::Vector3d& corner : laid.corners_mm) {
    const Eigen::Vector3d at = corner - origin;
    laid.net.emplace_back(from + at.dot(along) * net_along + at.dot(inward) * left_of(net_along));
  }
  return laid;
}

// Outside of the edge, which a face has on its left.
GlueTab tab_at(const NetPoint& from, const NetPoint& to, double depth_mm) {
  const NetPoint along = (to - from).normalized();
  const NetPoint out = -depth_mm * left_of(along);
  const double slant_mm = std::min(depth_mm, 0.3 * (to - from).norm());
  return {from, to, to - slant_mm * along + out, from + slant_mm * along + out};
}

void add_tab(NetPiece& piece, const GlueTab& tab) {
  piece.tabs.push_back(tab);
  piece.cuts.push_back({tab[1], tab[2], tab[3], tab[0]});
}

// The edges of a laid face: folds, tabs or cuts. Two faces that meet at a cut share one tab.
void finish_edges(const Solid& solid, std::size_t number, NetPiece& shell) {
  const SolidFace& face = solid.faces[number];
  const NetPolygon& net = shell.faces[number].net;
  for (std::size_t i = 0; i < net.size(); ++i) {
    const std::size_t next = (i + 1) % net.size();
    std::size_t other = 0;
    while (!find_edge(solid.faces[other], face.corners[next], face.corners[i])) ++other;
    const bool is_fold =
        other + 1 < solid.faces.size() &&
        (face.parent == static_cast<int>(other) || solid.faces[other].parent == static_cast<int>(number));
    if (is_fold) {
      if (other > number) shell.folds.push_back({net[i], net[next]});
    } else if (other > number) {
      add_tab(shell, tab_at(net[i], net[next], kTabMm));
    } else {
      shell.cuts.push_back({net[i], net[next]});
    }
  }
}

std::vector<NetPiece> unfold_solid(const Solid& solid) {
  NetPiece shell{"shell", true, {}, {}, {}, {}};
  const std::size_t sides = solid.faces.size() - 1;
  for (std::size_t number = 0; number < sides; ++number) {
    const SolidFace& face = solid.faces[number];
    if (face.parent == kRoot) {
      const double length = (solid.corners_mm[face.corners[1]] - solid.corners_mm[face.corners[0]]).norm();
      shell.faces.push_back(lay(solid, face, 0, {0.0, 0.0}, {length, 0.0}));
      continue;
    }
    const auto parent = static_cast<std::size_t>(face.parent);
    const SolidFace& parent_face = solid.faces[parent];
    const std::size_t count = parent_face.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t next = (i + 1) % count;
      const auto edge = find_edge(face, parent_face.corners[next], parent_face.corners[i]);
      if (!edge) continue;
      const NetPolygon& net = shell.faces[parent].net;
      const NetPoint from = net[next];
      const NetPoint to = net[i];
      shell.faces.push_back(lay(solid, face, *edge, from, to));
      break;
    }
  }
  for (std::size_t number = 0; number < sides; ++number) finish_edges(solid, number, shell);

  NetPiece bottom{"bottom", false, {}, {}, {}, {}};
  const SolidFace& face = solid.faces.back();
  const double length = (solid.corners_mm[face.corners[1]] - solid.corners_mm[face.corners[0]]).norm();
  bottom.faces.push_back(lay(solid, face, 0, {0.0, 0.0}, {length, 0.0}));
  NetPolygon outline = bottom.faces.front().net;
  outline.push_back(outline.front());
  bottom.cuts.push_back(std::move(outline));
  return {std::move(shell), std::move(bottom)};
}

// About the origin, from one direction to another.
NetPolygon arc(double radius_mm, double from_rad, double to_rad) {
  const int steps =
      std::max(2, static_cast<int>(std::ceil(radius_mm * std::abs(to_rad - from_rad) / kArcStepMm)));
  NetPolygon points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = from_rad + (to_rad - from_rad) * i / steps;
    points.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle));
  }
  return points;
}

// Tabs along an arc, on the right of its direction.
void add_teeth(NetPiece& piece, double radius_mm, double from_rad, double to_rad) {
  const int teeth = static_cast<int>(std::ceil(radius_mm * std::abs(to_rad - from_rad) / kToothMm));
  for (int i = 0; i < teeth; ++i) {
    const NetPolygon ends = arc(radius_mm, from_rad + (to_rad - from_rad) * i / teeth,
                                from_rad + (to_rad - from_rad) * (i + 1) / teeth);
    add_tab(piece, tab_at(ends.front(), ends.back(), kTabMm));
  }
}

NetPiece disc(const std::string& name, double diameter_mm, bool is_textured) {
  NetPiece piece{name, is_textured, {}, {}, {}, {}};
  NetPolygon circle = arc(0.5 * diameter_mm, 0.0, 2.0 * std::numbers::pi);
  piece.cuts.push_back(circle);
  circle.pop_back();
  piece.faces.push_back({{}, std::move(circle)});
  return piece;
}

std::vector<NetPiece> unfold_cone(const BodySize& size_mm) {
  const ConeSheet sheet = unroll_cone(size_mm);
  const double right = 0.5 * std::numbers::pi - 0.5 * sheet.angle_rad;
  const double left = right + sheet.angle_rad;
  NetPiece side{"shell", true, {}, {}, {}, {}};
  NetPolygon ring = arc(sheet.outer_radius_mm, right, left);
  const NetPolygon inner = arc(sheet.inner_radius_mm, left, right);
  const NetPoint seam_from = ring.back();
  ring.insert(ring.end(), inner.begin(), inner.end());
  side.cuts.push_back({inner.back(), ring.front()});
  add_tab(side, tab_at(seam_from, inner.front(), kTabMm));
  add_teeth(side, sheet.outer_radius_mm, right, left);
  add_teeth(side, sheet.inner_radius_mm, left, right);
  side.faces.push_back({{}, std::move(ring)});
  return {std::move(side), disc("top", size_mm[1], true), disc("bottom", size_mm[0], false)};
}

}  // namespace

ConeSheet unroll_cone(const BodySize& size_mm) {
  const double below = 0.5 * size_mm[0];
  const double above = 0.5 * size_mm[1];
  const double slant = std::hypot(below - above, size_mm[2]);
  const double outer = below * slant / (below - above);
  return {outer - slant, outer, 2.0 * std::numbers::pi * below / outer};
}

std::vector<NetPiece> unfold(const ProofBody& body) {
  if (body.kind == BodyKind::cone) return unfold_cone(body.size_mm);
  return unfold_solid(solid_of(body.kind, body.size_mm));
}

}  // namespace traygauge
