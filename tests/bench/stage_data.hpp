// The inputs of every stage of profile `paper`, prepared once from a scene by the stages before it.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/triangulation.hpp"
#include "core/image/resample.hpp"
#include "tests/bench/scene.hpp"

namespace traygauge::bench {

struct ViewFeatures {
  cv::Mat picture;  // grey, the frame at the scale at which salient points are looked for
  std::vector<paper::Keypoint> keypoints;
  std::vector<paper::Descriptor> descriptors;

  paper::FeatureSet set() const { return {keypoints, descriptors}; }
};

struct StageData {
  explicit StageData(const Scene& scene);

  const Scene& scene;
  PaperSession session;
  const Measurement& measurement;  // of `session`; its views are the dense stages' input

  std::array<cv::Mat, 2> gray;  // of the frames
  std::array<ViewFeatures, 2> features;
  std::vector<RayMatch> rays;              // of all matches
  std::vector<RayMatch> inliers;           // reference first
  std::array<Roi, 2> cutouts;              // of the working pictures, reference first
  std::array<const Picture*, 2> frames{};  // reference first, as all that follows
  std::array<cv::Mat, 2> working;          // grey
  std::array<cv::Mat, 2> working_labels;
  std::array<cv::Mat, 2> regions;  // 255 on the dish
  Pose other_from_reference;       // mm
  std::array<cv::Mat, 2> rectified;
  std::array<cv::Mat, 2> rectified_regions;
};

template <class T = std::uint8_t>
ImageView<const T> view_of(const cv::Mat& mat) {
  return {mat.ptr<T>(), mat.cols, mat.rows, static_cast<std::ptrdiff_t>(mat.step1())};
}
template <class T = std::uint8_t>
ImageView<T> target_of(cv::Mat& mat) {
  return {mat.ptr<T>(), mat.cols, mat.rows, static_cast<std::ptrdiff_t>(mat.step1())};
}

}  // namespace traygauge::bench
