// A proof body unfolded: what is printed, cut out, folded and glued.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "simulator/bodies/proof_body.hpp"

namespace traygauge {

// mm on the sheet, seen from its printed side: x to the right, y up.
using NetPoint = Eigen::Vector2d;
using NetPolygon = std::vector<NetPoint>;

// A polygon of a body, flat in space and on the sheet. Its corners are counter-clockwise seen from outside.
struct NetFace {
  std::vector<Eigen::Vector3d> corners_mm;  // in the body's frame; none on the sheet of a cone, which is bent
  NetPolygon net;
};

// A flap that is folded inward at the line from its first to its second corner, and glued.
using GlueTab = std::array<NetPoint, 4>;
using NetLine = std::array<NetPoint, 2>;

// What is cut out in one piece.
struct NetPiece {
  std::string name;
  bool is_textured = true;
  std::vector<NetFace> faces;
  std::vector<NetLine> folds;  // between faces
  std::vector<GlueTab> tabs;
  std::vector<NetPolygon> cuts;  // open lines: all edges at which scissors run
};

// A cone's side as a part of a ring about the origin, symmetric about the y axis.
struct ConeSheet {
  double inner_radius_mm = 0.0;
  double outer_radius_mm = 0.0;
  double angle_rad = 0.0;
};
ConeSheet unroll_cone(const BodySize& size_mm);

// The body stands on z = 0, its middle above the origin, its length along x. Pieces: 0 is the shell; of a
// cone 1 is the disc on top. The last one is the bottom, without texture.
std::vector<NetPiece> unfold(const ProofBody& body);

}  // namespace traygauge
