// A ViewCamera as OpenCV's functions take it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "simulator/render/view_camera.hpp"

namespace traygauge {

inline cv::Matx33d matrix_of(const ViewCamera& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

inline std::vector<double> coefficients_of(const ViewCamera& camera) {
  return {camera.distortion.begin(), camera.distortion.end()};
}

}  // namespace traygauge
