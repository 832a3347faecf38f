// A camera as OpenCV's functions take it.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/camera.hpp"

namespace traygauge::test {

inline cv::Matx33d camera_matrix(const PinholeCamera& camera) {
  return {camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0};
}

inline std::vector<double> distortion_of(const LensModel& lens) {
  return {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
}

}  // namespace traygauge::test
