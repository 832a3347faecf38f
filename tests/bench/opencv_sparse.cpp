#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/image/resample.hpp"
#include "tests/bench/opencv_measurement.hpp"

namespace traygauge::bench {

SparsePoints find_sift(const cv::Mat& gray, const cv::Rect& box, double scale, int count) {
  constexpr double kContrast = 0.02;
  constexpr double kOffsetPx = 0.25;  // OpenCV 4.6 puts every point so far right and down
  cv::Mat picture = gray(box);
  if (scale < 1.0) cv::resize(picture, picture, {}, scale, scale, cv::INTER_AREA);
  const double scale_x = static_cast<double>(picture.cols) / box.width;
  const double scale_y = static_cast<double>(picture.rows) / box.height;
  std::vector<cv::KeyPoint> keypoints;
  SparsePoints points;
  cv::SIFT::create(count, 3, kContrast)->detectAndCompute(picture, {}, keypoints, points.descriptors);
  for (const cv::KeyPoint& keypoint : keypoints) {
    points.pixels.emplace_back(scale_coordinate(keypoint.pt.x - kOffsetPx, 1.0 / scale_x) + box.x,
                               scale_coordinate(keypoint.pt.y - kOffsetPx, 1.0 / scale_y) + box.y);
  }
  for (int i = 0; i < points.descriptors.rows; ++i) {
    cv::Mat row = points.descriptors.row(i);
    cv::sqrt(row / std::max(1e-6, cv::norm(row, cv::NORM_L1)), row);
  }
  return points;
}

std::vector<cv::Point> match_symmetric(cv::DescriptorMatcher& matcher, const cv::Mat& first,
                                       const cv::Mat& second, float ratio) {
  std::vector<std::vector<cv::DMatch>> forward;
  std::vector<std::vector<cv::DMatch>> backward;
  std::vector<cv::Point> pairs;
  if (first.rows < 2 || second.rows < 2) return pairs;
  matcher.knnMatch(first, second, forward, 2);
  matcher.knnMatch(second, first, backward, 2);
  for (const auto& candidates : forward) {
    if (candidates.size() < 2 || candidates[0].distance > ratio * candidates[1].distance) continue;
    const cv::DMatch& best = candidates[0];
    const auto& back = backward[static_cast<std::size_t>(best.trainIdx)];
    if (!back.empty() && back[0].trainIdx == best.queryIdx) pairs.emplace_back(best.queryIdx, best.trainIdx);
  }
  return pairs;
}

}  // namespace traygauge::bench
