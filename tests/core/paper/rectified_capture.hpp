// Rectified dishes with true disparities, from captures whose poses and depth are known.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "tests/core/paper/stereo_scene.hpp"

namespace traygauge::test {

struct RectifiedCapture {
  TestPair pair;                     // dish pixels within the masks
  cv::Mat_<std::uint8_t> labels;     // of the first picture
  cv::Mat_<float> truth;             // disparity of the first picture, in px
  std::map<int, std::string> names;  // of the items, by label; scanned ones left out
  DisparityRange range;              // that holds the central 90 %, enlarged

  // The point that a disparity stands for, above the dish's bottom, in mm.
  cv::Vec3d point(int x, int y, double disparity_px) const;

  double focal_px = 0.0;
  double baseline_mm = 0.0;               // along the rectified x axis, with its sign
  cv::Point first_origin, second_origin;  // rectified coordinates of the pixels (0, 0), centre at 0
  cv::Matx33d rectified_from_world;
  cv::Vec3d first_centre_mm;  // above the dish's bottom
};

// The views 0 and `second` of a capture; scaled so that the dish measures 2^17 px (paper III-B-2).
RectifiedCapture rectify_capture(const std::filesystem::path& folder, int second);

// Volume above the dish's bottom under the pixels of a label, in ml, by the given disparities (kNoDisparity
// and NaN leave holes).
double volume_ml(const RectifiedCapture& capture, int label, const cv::Mat_<float>& disparity_px);

}  // namespace traygauge::test
