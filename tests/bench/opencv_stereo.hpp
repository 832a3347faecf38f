// Planar rectification and semi-global matching for the peer measurement.
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/labels/label_regions.hpp"
#include "tests/support/opencv_camera.hpp"

namespace traygauge::bench {

cv::Matx33d rotation_matrix(const Mat3& rotation);
cv::Vec3d vector_of(const Vec3& vector);
cv::Rect as_rect(const PixelBox& box);

struct OpenCvLens {
  explicit OpenCvLens(const LensModel& lens);

  cv::Matx33d camera;
  std::vector<double> distortion;
};

// Both views of a measurement, in mm and in the reference camera's frame.
struct OpenCvStereoInput {
  std::array<cv::Mat, 2> gray;
  std::array<cv::Mat, 2> labels;
  cv::Matx33d rotation;  // other from reference
  cv::Vec3d translation;
  cv::Vec3d bottom_normal;  // of the dish's bottom, unit, up
  double bottom_offset = 0.0;
  std::vector<cv::Vec3d> dish_points;  // sparse ones, for the range of disparities

  OpenCvStereoInput swapped() const;
};

std::map<int, double> volumes_by_sgbm(const OpenCvStereoInput& input, const OpenCvLens& lens);

}  // namespace traygauge::bench
