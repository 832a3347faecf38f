// Two views of a rendered capture as the estimator would prepare them: undistorted, cut out, the dish scaled
// to a fixed number of pixels; with the true motion and, for view 0, the true depth.
#pragma once

#include <opencv2/core.hpp>

#include "core/image_view/image_view.hpp"
#include "tests/support/capture_truth.hpp"

namespace traygauge::paper {

struct WorkingView {
  PinholeCamera camera;
  cv::Mat gray;
  cv::Mat region;  // 1 on the dish and its food
  cv::Mat depth;   // mm, 32-bit; empty but for view 0
  Pose camera_from_world;

  static ImageView<const std::uint8_t> view(const cv::Mat& mat) { return {mat.data, mat.cols, mat.rows}; }
};

WorkingView load_view(const test::CaptureTruth& capture, int index,
                      double dish_pixels = test::kWorkingDishPixels);

}  // namespace traygauge::paper
