// Matches of rendered and real pictures with known motion, by OpenCV's SIFT.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/features2d.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/paper/pose/relative_pose.hpp"
#include "tests/support/capture_truth.hpp"

namespace traygauge::test {

struct Features {
  std::vector<cv::Point2d> rays;
  cv::Mat descriptors;
};

inline Features detect(const TrueView& view, int max_features) {
  constexpr double kSiftShiftPx = 0.25;  // OpenCV 4.6 reports positions that much too far right and down
  std::vector<cv::KeyPoint> keypoints;
  Features features;
  cv::SIFT::create(max_features)
      ->detectAndCompute(view.read_gray(), cv::noArray(), keypoints, features.descriptors);
  std::vector<cv::Point2d> pixels;
  for (const cv::KeyPoint& keypoint : keypoints) {
    pixels.emplace_back(static_cast<double>(keypoint.pt.x) - kSiftShiftPx,
                        static_cast<double>(keypoint.pt.y) - kSiftShiftPx);
  }
  features.rays = view.rays(pixels);
  return features;
}

// Mutual best matches that are 1.1 times nearer than the second best (the paper's distinctiveness).
inline std::vector<RayMatch> match(const Features& first, const Features& second) {
  const auto best = [](const Features& from, const Features& to) {
    std::vector<std::vector<cv::DMatch>> candidates;
    cv::BFMatcher().knnMatch(from.descriptors, to.descriptors, candidates, 2);
    std::vector<int> index(from.rays.size(), -1);
    for (const auto& pair : candidates) {
      if (pair.size() < 2 || 1.1F * pair[0].distance > pair[1].distance) continue;
      index[static_cast<std::size_t>(pair[0].queryIdx)] = pair[0].trainIdx;
    }
    return index;
  };
  const std::vector<int> forth = best(first, second);
  const std::vector<int> back = best(second, first);
  std::vector<RayMatch> matches;
  for (std::size_t i = 0; i < forth.size(); ++i) {
    if (forth[i] < 0 || back[static_cast<std::size_t>(forth[i])] != static_cast<int>(i)) continue;
    const cv::Point2d& a = first.rays[i];
    const cv::Point2d& b = second.rays[static_cast<std::size_t>(forth[i])];
    matches.push_back({{a.x, a.y}, {b.x, b.y}});
  }
  return matches;
}

// Views of a folder, features computed once each.
class PhotographSet {
 public:
  PhotographSet(std::vector<TrueView> views, int max_features)
      : views_(std::move(views)), max_features_(max_features) {}

  std::vector<RayMatch> matches(std::size_t first, std::size_t second) {
    return match(features(first), features(second));
  }
  Pose second_from_first(std::size_t first, std::size_t second) const {
    return motion_between(views_[first].camera_from_world, views_[second].camera_from_world);
  }
  double focal_px() const { return views_[0].lens.pinhole.mean_focal_px(); }
  std::size_t index(const std::string& image) const {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      if (views_[i].image.filename() == image) return i;
    }
    return 0;
  }

 private:
  const Features& features(std::size_t view) {
    const auto found = features_.find(view);
    if (found != features_.end()) return found->second;
    return features_[view] = detect(views_[view], max_features_);
  }
  std::vector<TrueView> views_;
  int max_features_;
  std::map<std::size_t, Features> features_;
};

inline PhotographSet read_capture(const std::filesystem::path& folder, int max_features) {
  return {read_capture_truth(folder).views, max_features};
}

// A folder of `real` with cameras.json.
inline PhotographSet read_real(const std::filesystem::path& folder, int max_features) {
  return {read_real_views(folder), max_features};
}

}  // namespace traygauge::test
