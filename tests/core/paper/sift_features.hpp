// OpenCV's SIFT as a source of real descriptors, folded to 64 numbers.
#pragma once

#include <algorithm>
#include <opencv2/features2d.hpp>
#include <vector>

#include "tests/core/paper/feature_scenes.hpp"

namespace traygauge::paper {

// The `count` strongest. Neighbouring orientation bins are added up: 4 × 4 cells of four orientations.
inline Features sift_features(const cv::Mat& gray, int count) {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat rows;
  cv::SIFT::create(count)->detectAndCompute(gray, cv::noArray(), keypoints, rows);
  Features features;
  for (int i = 0; i < std::min(rows.rows, count); ++i) {
    Descriptor descriptor{};
    for (int d = 0; d < 2 * kDescriptorLength; ++d) {
      descriptor[static_cast<std::size_t>(d / 2)] += rows.at<float>(i, d);
    }
    normalise(descriptor);
    Keypoint keypoint;
    const cv::Point2f pixel = keypoints[static_cast<std::size_t>(i)].pt;
    keypoint.pixel = Vec2(static_cast<double>(pixel.x), static_cast<double>(pixel.y));
    features.keypoints.push_back(keypoint);
    features.descriptors.push_back(descriptor);
  }
  return features;
}

}  // namespace traygauge::paper
