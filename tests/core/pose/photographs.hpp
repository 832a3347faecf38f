// Matches of rendered and real pictures with known motion, by OpenCV's SIFT.
#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/pose/relative_pose.hpp"

namespace traygauge::testing {

// Empty when the captures are not at hand.
inline std::string captures_folder() {
  const char* folder = std::getenv("TRAYGAUGE_CAPTURES");
  return folder == nullptr ? "" : folder;
}

inline nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

struct View {
  std::string image;
  cv::Matx33d camera;
  std::vector<double> distortion;
  Pose camera_from_world;
};

struct Features {
  std::vector<cv::Point2d> rays;
  cv::Mat descriptors;
};

inline Features detect(const View& view, int max_features) {
  constexpr double kSiftShiftPx = 0.25;  // OpenCV 4.6 reports positions that much too far right and down
  std::vector<cv::KeyPoint> keypoints;
  Features features;
  cv::SIFT::create(max_features)
      ->detectAndCompute(cv::imread(view.image, cv::IMREAD_GRAYSCALE), cv::noArray(), keypoints,
                         features.descriptors);
  std::vector<cv::Point2d> pixels;
  for (const cv::KeyPoint& keypoint : keypoints) {
    pixels.emplace_back(static_cast<double>(keypoint.pt.x) - kSiftShiftPx,
                        static_cast<double>(keypoint.pt.y) - kSiftShiftPx);
  }
  cv::undistortPoints(pixels, features.rays, view.camera, view.distortion);
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
  PhotographSet(std::vector<View> views, int max_features)
      : views_(std::move(views)), max_features_(max_features) {}

  std::vector<RayMatch> matches(std::size_t first, std::size_t second) {
    return match(features(first), features(second));
  }
  Pose second_from_first(std::size_t first, std::size_t second) const {
    const Pose& a = views_[first].camera_from_world;
    const Pose& b = views_[second].camera_from_world;
    const Mat3 rotation = b.rotation * a.rotation.transpose();
    return {rotation, b.translation - rotation * a.translation};
  }
  double focal_px() const { return 0.5 * (views_[0].camera(0, 0) + views_[0].camera(1, 1)); }
  std::size_t index(const std::string& image) const {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      if (views_[i].image.ends_with("/" + image)) return i;
    }
    return 0;
  }

 private:
  const Features& features(std::size_t view) {
    const auto found = features_.find(view);
    if (found != features_.end()) return found->second;
    return features_[view] = detect(views_[view], max_features_);
  }
  std::vector<View> views_;
  int max_features_;
  std::map<std::size_t, Features> features_;
};

// A capture: capture.json and the world-to-camera poses of truth.json.
inline PhotographSet read_capture(const std::string& folder, int max_features) {
  const nlohmann::json capture = read_json(folder + "/capture.json");
  const nlohmann::json truth = read_json(folder + "/truth.json");
  const nlohmann::json& camera = capture.at("camera");
  std::vector<View> views;
  for (const nlohmann::json& entry : capture.at("views")) {
    View view;
    view.image = folder + "/" + entry.at("image").get<std::string>();
    view.camera =
        cv::Matx33d(camera.at("fx"), 0, camera.at("cx"), 0, camera.at("fy"), camera.at("cy"), 0, 0, 1);
    view.distortion = camera.at("distortion").get<std::vector<double>>();
    const auto pose = truth.at("poses").at(views.size()).get<std::vector<std::vector<double>>>();
    for (std::size_t row = 0; row < 3; ++row) {
      const auto i = static_cast<Eigen::Index>(row);
      view.camera_from_world.rotation.row(i) = Eigen::Map<const Eigen::RowVector3d>(pose[row].data());
      view.camera_from_world.translation[i] = pose[row][3];
    }
    views.push_back(view);
  }
  return {views, max_features};
}

// A folder of `real` with cameras.json.
inline PhotographSet read_real(const std::string& folder, int max_features) {
  std::vector<View> views;
  const nlohmann::json cameras = read_json(folder + "/cameras.json");
  for (const nlohmann::json& entry : cameras.at("views")) {
    View view;
    view.image = folder + "/" + entry.at("image").get<std::string>();
    const auto camera = entry.at("K").get<std::vector<double>>();
    const auto rotation = entry.at("R").get<std::vector<double>>();
    const auto translation = entry.at("t").get<std::vector<double>>();
    view.camera = cv::Matx33d(camera.data());
    view.camera_from_world.rotation =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data());
    view.camera_from_world.translation = Eigen::Map<const Vec3>(translation.data());
    view.distortion = entry.value("dist_k1k2p1p2k3", std::vector<double>(5, 0.0));
    views.push_back(view);
  }
  return {views, max_features};
}

}  // namespace traygauge::testing
