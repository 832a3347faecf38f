// A proof body in space: its mesh, and which place of its sheet a point of it shows.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/bodies/body_net.hpp"
#include "simulator/render/mesh.hpp"

namespace traygauge {

class BodySurface {
 public:
  explicit BodySurface(const ProofBody& body);

  // Closed, in the frame of unfold(). A cone has as many sides as its volume needs to be exact within 1e-6.
  TriangleMesh mesh() const;

  // The printed grey at a point of the surface with this outward normal, sRGB from 0 to 255; the bottom is
  // paper.
  std::uint8_t gray_at(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal) const;

 private:
  // A flat face and how it lies on the sheet.
  struct Facet {
    int piece = 0;
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d origin_mm = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 2, 3> net_from_body;
    NetPoint net_origin = NetPoint::Zero();
    bool is_textured = true;
  };

  std::uint8_t gray_of(int piece, const NetPoint& place) const;
  std::uint8_t gray_of_cone(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal) const;
  TriangleMesh cone_mesh() const;

  ProofBody body_;
  std::string id_;
  std::vector<NetPiece> pieces_;
  std::vector<Facet> facets_;  // none of a cone
  ConeSheet cone_;
};

}  // namespace traygauge
