// Captures with truth, their features by OpenCV's SIFT folded to 64 numbers, and their card tracks with the
// true relative pose.
#pragma once

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/card/card.hpp"
#include "core/paper/card/card_tracks.hpp"
#include "core/paper/matching/matcher.hpp"
#include "tests/core/card/synthetic_card.hpp"
#include "tests/core/paper/sift_features.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/capture_truth.hpp"

namespace traygauge::paper {

inline constexpr int kMaxCaptureFeatures = 6000;  // fewer all go to the table's texture

struct CaptureView {
  Features features;
  std::vector<Vec2> rays;
  Pose camera_from_world;
};

struct CardCapture {
  CardModelSize size;
  double focal_px = 0.0;
  std::vector<CaptureView> views;
  Features pattern;
  std::vector<Vec2> pattern_mm;
  Pose world_from_card;
};

inline CaptureView load_view(const test::TrueView& stored) {
  CaptureView view;
  view.features = sift_features(stored.read_gray(), kMaxCaptureFeatures);
  std::vector<cv::Point2d> pixels;
  for (const Keypoint& keypoint : view.features.keypoints) {
    pixels.emplace_back(keypoint.pixel.x(), keypoint.pixel.y());
  }
  for (const cv::Point2d& ray : stored.rays(pixels)) view.rays.emplace_back(ray.x, ray.y);
  view.camera_from_world = stored.camera_from_world;
  return view;
}

inline void load_pattern(const std::filesystem::path& image, CardCapture& capture) {
  constexpr double kShrink = 0.15;  // to about the resolution at which the card is seen
  cv::Mat pattern = cv::imread(image.string(), cv::IMREAD_GRAYSCALE);
  cv::resize(pattern, pattern, {}, kShrink, kShrink, cv::INTER_AREA);
  capture.pattern = sift_features(pattern, kMaxCaptureFeatures);
  for (const Keypoint& keypoint : capture.pattern.keypoints) {
    capture.pattern_mm.push_back(pattern_mm(keypoint.pixel, pattern.cols, capture.size));
  }
}

inline CardCapture load_card_capture(const std::filesystem::path& folder,
                                     const std::vector<std::size_t>& views) {
  const test::CaptureTruth truth = test::read_capture_truth(folder);
  const nlohmann::json& card = truth.description.at("card");
  CardCapture capture;
  capture.size = {card.at("width_mm"), card.at("height_mm"), card.at("thickness_mm")};
  capture.focal_px = truth.views[0].lens.pinhole.fx_px;
  for (const std::size_t view : views) capture.views.push_back(load_view(truth.views.at(view)));
  load_pattern(folder / card.at("pattern").get<std::string>(), capture);
  const std::vector<Vec3>& corners = truth.card_corners_mm;
  const Vec3& origin = corners[0];
  const Vec3 x = (corners[1] - origin).normalized();
  const Vec3 y = (corners[3] - origin).normalized();
  capture.world_from_card.rotation << x, y, x.cross(y);
  capture.world_from_card.translation = origin;
  return capture;
}

inline std::vector<Match> match_sets(const Features& first, const Features& second) {
  static test::Allocated<MatcherWorkspace> memory(kMaxCaptureFeatures);
  std::vector<Match> storage(static_cast<std::size_t>(kMaxCaptureFeatures));
  BoundedList<Match> matches(storage);
  match_features(first.view(), second.view(), {}, *memory, matches);
  return {matches.begin(), matches.end()};
}

// The scene of one pair of views: tracks from real matches, cloud from the true pose, inliers within
// `max_epipolar_px`.
inline CardScene load_card_scene(const CardCapture& capture, std::size_t first, std::size_t second,
                                 double max_epipolar_px = 1.0) {
  const CaptureView& a = capture.views[first];
  const CaptureView& b = capture.views[second];
  CardScene scene;
  scene.second_from_first = test::motion_between(a.camera_from_world, b.camera_from_world);
  scene.baseline_mm = scene.second_from_first.translation.norm();
  scene.first_from_card = a.camera_from_world * capture.world_from_card;
  scene.second_from_card = b.camera_from_world * capture.world_from_card;
  Pose unit_pose = scene.second_from_first;
  unit_pose.translation.normalize();
  const Mat3 essential = essential_matrix(unit_pose);
  const auto first_second = match_sets(a.features, b.features);
  std::vector<std::uint8_t> in_cloud;
  std::vector<Vec3> cloud;
  for (const Match& match : first_second) {
    const Vec2& ray_a = a.rays[static_cast<std::size_t>(match.first)];
    const Vec2& ray_b = b.rays[static_cast<std::size_t>(match.second)];
    const Vec3 line = essential * ray_a.homogeneous();
    const double distance = std::abs(line.dot(ray_b.homogeneous())) / line.head<2>().norm();
    in_cloud.push_back(distance * capture.focal_px <= max_epipolar_px ? 1 : 0);
    cloud.push_back(triangulate_midpoint(unit_pose, ray_a, ray_b));
  }
  const auto first_pattern = match_sets(a.features, capture.pattern);
  const auto second_pattern = match_sets(b.features, capture.pattern);
  std::vector<CardTrack> storage(static_cast<std::size_t>(kMaxCaptureFeatures));
  BoundedList<CardTrack> tracks(storage);
  build_card_tracks(
      {first_second, in_cloud, cloud, first_pattern, second_pattern, a.rays, b.rays, capture.pattern_mm},
      tracks);
  scene.tracks.assign(tracks.begin(), tracks.end());
  return scene;
}

}  // namespace traygauge::paper
