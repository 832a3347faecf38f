// Two views of a rendered capture as the estimator would prepare them: undistorted, cut out, the dish scaled
// to a fixed number of pixels; with the true motion and, for view 0, the true depth.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/base/geometry.hpp"
#include "core/image/camera.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

struct WorkingView {
  PinholeCamera camera;
  cv::Mat gray;
  cv::Mat region;  // 1 on the dish and its food
  cv::Mat depth;   // mm, 32-bit; empty but for view 0
  Pose camera_from_world;

  static ImageView<const std::uint8_t> view(const cv::Mat& mat) { return {mat.data, mat.cols, mat.rows}; }
};

inline constexpr double kDishPixels = 131072.0;  // 2^17

WorkingView load_view(const std::string& capture, int view, double dish_pixels = kDishPixels);
std::vector<std::pair<int, int>> capture_pairs(const std::string& capture);
// The folder that TRAYGAUGE_CAPTURES names; empty when it does not.
std::string captures_folder();

}  // namespace traygauge
