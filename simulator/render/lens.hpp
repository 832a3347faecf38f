// OpenCV's lens model, written from its definition and independent of core's, so that a shared mistake cannot
// cancel out.
#pragma once

#include <Eigen/Core>

#include "simulator/render/view_camera.hpp"

namespace traygauge {

// Between pixels and directions (x/z, y/z). The model: r² = x² + y², c = 1 + k1 r² + k2 r⁴ + k3 r⁶,
// x' = c x + 2 p1 x y + p2 (r² + 2 x²), y' = c y + p1 (r² + 2 y²) + 2 p2 x y, u = fx x' + cx, v = fy y' + cy.
class Lens {
 public:
  // Throws std::invalid_argument unless the focal lengths are positive and every pixel, with a margin of
  // kMargin_px around the picture, is seen in one direction: the lens does not fold over.
  explicit Lens(const ViewCamera& camera);

  static constexpr double kMargin_px = 2.0;

  Eigen::Vector2d pixel_of(const Eigen::Vector2d& direction) const;
  // Of a pixel in the picture or its margin.
  Eigen::Vector2d direction_of(const Eigen::Vector2d& pixel) const;
  // How the direction changes with the pixel, there.
  Eigen::Matrix2d direction_by_pixel(const Eigen::Vector2d& direction) const;

 private:
  struct Solution {
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();
    bool converged = false;
  };

  Eigen::Vector2d distort(const Eigen::Vector2d& direction) const;
  Eigen::Matrix2d distortion_slope(const Eigen::Vector2d& direction) const;
  Solution solve(const Eigen::Vector2d& pixel) const;
  bool is_one_to_one_up_to(const Eigen::Vector2d& direction) const;
  void check_no_fold(int width, int height) const;

  Eigen::Vector2d focal_px_;
  Eigen::Vector2d center_px_;
  double k1_, k2_, p1_, p2_, k3_;
};

}  // namespace traygauge
