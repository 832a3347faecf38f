// The camera of the renderer: OpenCV's lens model, written independently of core's, with a real aperture.
#pragma once

#include <Eigen/Geometry>
#include <array>

namespace traygauge {

// Pixels are those of the picture as stored; origin: centre of the top left pixel.
struct ViewCamera {
  int width = 1600;
  int height = 1200;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  std::array<double, 5> distortion{};                                   // k1, k2, p1, p2, k3
  Eigen::Isometry3d camera_from_world = Eigen::Isometry3d::Identity();  // OpenCV axes, mm
  double aperture_mm = 0.0;  // diameter of the pupil; 0: all is sharp
  double focus_mm = 500.0;   // along the optical axis
  // Where the camera is when the shutter closes; it moves evenly from camera_from_world. Truth is that of the
  // start and the end together: their middle.
  Eigen::Isometry3d camera_from_world_at_end = Eigen::Isometry3d::Identity();
  bool moves = false;
};

}  // namespace traygauge
