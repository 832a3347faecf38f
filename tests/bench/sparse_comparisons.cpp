// Salient points, matching and relative pose.
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

#include "core/base/random.hpp"
#include "core/paper/image/integral.hpp"
#include "core/paper/pose/five_point.hpp"
#include "tests/bench/comparisons.hpp"
#include "tests/bench/opencv_measurement.hpp"
#include "tests/bench/workspace.hpp"

namespace traygauge::bench {
namespace {

constexpr int kSiftPoints = 4000;

Method surf_method(const StageData& data) {
  const cv::Mat& picture = data.features[0].picture;
  const paper::Configuration& configuration = data.session.configuration;
  const auto workspace =
      std::make_shared<OwnedWorkspace<paper::SurfWorkspace>>(picture.cols, configuration.surf);
  const auto cap = static_cast<std::size_t>(configuration.caps.max_keypoints);
  return {"ours", [&picture, &configuration, workspace, keypoints = std::vector<paper::Keypoint>(cap),
                   descriptors = std::vector<paper::Descriptor>(cap),
                   sums = std::vector<std::uint32_t>(static_cast<std::size_t>(picture.cols + 1) *
                                                     static_cast<std::size_t>(picture.rows + 1))]() mutable {
            const ImageView<std::uint32_t> integral(sums.data(), picture.cols + 1, picture.rows + 1);
            paper::build_integral(view_of(picture), integral);
            BoundedList<paper::Keypoint> found(keypoints);
            paper::detect_surf(integral, configuration.surf, **workspace, found);
            paper::describe_surf(integral, found.items(), std::span(descriptors).first(found.size()));
            return static_cast<double>(found.size());
          }};
}

Method opencv_features(const std::string& name, const StageData& data, cv::Ptr<cv::Feature2D> detector) {
  return {name, [&picture = data.features[0].picture, detector] {
            std::vector<cv::KeyPoint> keypoints;
            cv::Mat descriptors;
            detector->detectAndCompute(picture, {}, keypoints, descriptors);
            return static_cast<double>(keypoints.size());
          }};
}

Comparison compare_features(const StageData& data) {
  return {"features",
          "points",
          {surf_method(data),
           opencv_features("cv::SIFT, 4000 points", data, cv::SIFT::create(kSiftPoints, 3, 0.02)),
           opencv_features("cv::ORB, 3000 points", data,
                           cv::ORB::create(data.session.configuration.caps.max_keypoints))}};
}

Method our_matching(const StageData& data) {
  const auto workspace = std::make_shared<OwnedWorkspace<paper::MatcherWorkspace>>(
      data.session.configuration.caps.max_keypoints);
  return {"ours", [&data, params = data.session.configuration.matcher, workspace,
                   storage = std::vector<paper::Match>(data.features[0].keypoints.size())]() mutable {
            BoundedList<paper::Match> matches(storage);
            paper::match_features(data.features[0].set(), data.features[1].set(), params, **workspace,
                                  matches);
            return static_cast<double>(matches.size());
          }};
}

// Two neighbours each way; a pair counts when it is mutual and passes the ratio from the first side.
Method opencv_matching(const std::string& name, const StageData& data, bool exhaustive) {
  const auto as_mat = [](const ViewFeatures& features) {
    return cv::Mat(static_cast<int>(features.descriptors.size()), paper::kDescriptorLength, CV_32F,
                   const_cast<float*>(features.descriptors.front().data()));
  };
  return {name, [first = as_mat(data.features[0]), second = as_mat(data.features[1]), exhaustive,
                 ratio = 1.0F / data.session.configuration.matcher.distinctiveness_ratio] {
            const cv::Ptr<cv::DescriptorMatcher> matcher = cv::DescriptorMatcher::create(
                exhaustive ? cv::DescriptorMatcher::BRUTEFORCE : cv::DescriptorMatcher::FLANNBASED);
            return static_cast<double>(match_symmetric(*matcher, first, second, ratio).size());
          }};
}

Comparison compare_matching(const StageData& data) {
  return {"matching",
          "matches",
          {our_matching(data), opencv_matching("cv::BFMatcher, symmetric", data, true),
           opencv_matching("cv::FlannBasedMatcher, sym.", data, false)}};
}

struct PointPairs {
  std::vector<cv::Point2d> first;
  std::vector<cv::Point2d> second;
};

PointPairs as_points(std::span<const RayMatch> rays) {
  PointPairs points;
  for (const RayMatch& ray : rays) {
    points.first.emplace_back(ray.first.x(), ray.first.y());
    points.second.emplace_back(ray.second.x(), ray.second.y());
  }
  return points;
}

// A hundred samples of five inliers, the same for both solvers.
Comparison compare_five_point(const StageData& data) {
  constexpr int kSamples = 100;
  std::vector<std::vector<RayMatch>> samples(kSamples);
  std::vector<PointPairs> points;
  Random random(1);
  for (auto& sample : samples) {
    for (int i = 0; i < 5; ++i)
      sample.push_back(data.inliers[random.below(static_cast<std::uint32_t>(data.inliers.size()))]);
    points.push_back(as_points(sample));
  }
  const auto ours = [samples] {
    int solutions = 0;
    std::array<Mat3, paper::kMaxEssentials> essentials;
    for (const auto& sample : samples) solutions += paper::solve_five_point(sample, essentials);
    return static_cast<double>(solutions);
  };
  const auto peer = [points] {
    int solutions = 0;
    const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
    for (const PointPairs& sample : points) {
      solutions +=
          cv::findEssentialMat(sample.first, sample.second, identity, cv::RANSAC, 0.99, 1e-3).rows / 3;
    }
    return static_cast<double>(solutions);
  };
  return {
      "five point", "models of 100", {{"ours, 100 samples", ours}, {"cv::findEssentialMat, 100 × 5", peer}}};
}

Method opencv_pose(const std::string& name, const StageData& data, int method) {
  const double threshold = 1.0 / data.scene.lens.pinhole.mean_focal_px();
  return {name, [points = as_points(data.rays), method, threshold] {
            const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
            cv::Mat mask;
            cv::Mat rotation;
            cv::Mat translation;
            const cv::Mat essential =
                cv::findEssentialMat(points.first, points.second, identity, method, 0.999, threshold, mask);
            if (essential.rows != 3) return 0.0;
            return static_cast<double>(cv::recoverPose(essential, points.first, points.second, identity,
                                                       rotation, translation, mask));
          }};
}

Comparison compare_pose(const StageData& data) {
  const paper::Configuration& configuration = data.session.configuration;
  const auto workspace = std::make_shared<OwnedWorkspace<paper::RelativePoseWorkspace>>(
      data.rays.size(), static_cast<std::size_t>(configuration.pose.noise_sample));
  const auto ours = [&data, &configuration, workspace,
                     flags = std::vector<std::uint8_t>(data.rays.size())]() mutable {
    Random random(1);
    paper::RelativePose pose;
    const Status status = paper::estimate_relative_pose(data.rays, data.scene.lens.pinhole.mean_focal_px(),
                                                        configuration.pose, random, **workspace, pose, flags);
    return status.ok() ? static_cast<double>(pose.inliers) : 0.0;
  };
  return {"pose",
          "inliers",
          {{"ours, refined", ours},
           opencv_pose("cv RANSAC + recoverPose", data, cv::RANSAC),
           opencv_pose("cv USAC_MAGSAC + recoverPose", data, cv::USAC_MAGSAC)}};
}

}  // namespace

std::vector<Comparison> compare_sparse_stages(const StageData& data) {
  return {compare_features(data), compare_matching(data), compare_five_point(data), compare_pose(data)};
}

}  // namespace traygauge::bench
