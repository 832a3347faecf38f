#include "tests/bench/stage_data.hpp"

#include <algorithm>
#include <cmath>

#include "core/image/resample.hpp"
#include "core/labels/label_regions.hpp"
#include "core/paper/image/integral.hpp"
#include "tests/bench/workspace.hpp"

namespace traygauge::bench {
namespace {

cv::Mat copy_of(ImageView<const std::uint8_t> view) {
  cv::Mat copy(view.height, view.width, CV_8U);
  for (int y = 0; y < view.height; ++y) std::copy_n(view.row(y), view.width, copy.ptr(y));
  return copy;
}

cv::Mat reduce_to_features(const cv::Mat& gray, const Picture& labels,
                           const paper::Configuration& configuration) {
  const double dish_px = measure_regions(labels.gray()).dish_pixels;
  const double scale =
      std::min({1.0, std::sqrt(configuration.view.feature_dish_px / dish_px),
                std::sqrt(configuration.caps.max_feature_px / (static_cast<double>(gray.cols) * gray.rows))});
  cv::Mat reduced(static_cast<int>(gray.rows * scale), static_cast<int>(gray.cols * scale), CV_8U);
  reduce_area(view_of(gray), target_of(reduced));
  return reduced;
}

void find_features(const paper::Configuration& configuration, ViewFeatures& features) {
  const cv::Mat& picture = features.picture;
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(picture.cols + 1) *
                                  static_cast<std::size_t>(picture.rows + 1));
  const ImageView<std::uint32_t> integral(sums.data(), picture.cols + 1, picture.rows + 1);
  paper::build_integral(view_of(picture), integral);
  OwnedWorkspace<paper::SurfWorkspace> workspace(picture.cols, configuration.surf);
  features.keypoints.resize(static_cast<std::size_t>(configuration.caps.max_keypoints));
  BoundedList<paper::Keypoint> found(features.keypoints);
  paper::detect_surf(integral, configuration.surf, *workspace, found);
  features.keypoints.resize(found.size());
  features.descriptors.resize(found.size());
  paper::describe_surf(integral, features.keypoints, features.descriptors);
}

std::vector<RayMatch> match_rays(const std::array<ViewFeatures, 2>& features, const LensModel& lens,
                                 const paper::Configuration& configuration) {
  OwnedWorkspace<paper::MatcherWorkspace> workspace(configuration.caps.max_keypoints);
  std::vector<paper::Match> storage(features[0].keypoints.size());
  BoundedList<paper::Match> matches(storage);
  paper::match_features(features[0].set(), features[1].set(), configuration.matcher, *workspace, matches);
  const double scale = static_cast<double>(features[0].picture.cols) / lens.width;
  const double second_scale = static_cast<double>(features[1].picture.cols) / lens.width;
  std::vector<RayMatch> rays;
  for (const paper::Match& match : matches.items()) {
    const Vec2 first = features[0].keypoints[static_cast<std::size_t>(match.first)].pixel;
    const Vec2 second = features[1].keypoints[static_cast<std::size_t>(match.second)].pixel;
    const auto in_frame = [](const Vec2& pixel, double s) {
      return Vec2(scale_coordinate(pixel.x(), 1.0 / s), scale_coordinate(pixel.y(), 1.0 / s));
    };
    RayMatch ray;
    if (lens.undistort_pixel(in_frame(first, scale), ray.first) &&
        lens.undistort_pixel(in_frame(second, second_scale), ray.second))
      rays.push_back(ray);
  }
  return rays;
}

std::vector<RayMatch> find_inliers(const std::vector<RayMatch>& rays, const Scene& scene,
                                   const paper::Configuration& configuration, bool swap) {
  OwnedWorkspace<paper::RelativePoseWorkspace> workspace(
      rays.size(), static_cast<std::size_t>(configuration.pose.noise_sample));
  Random random(1);
  paper::RelativePose pose;
  std::vector<std::uint8_t> flags(rays.size());
  const Status status = paper::estimate_relative_pose(rays, scene.lens.pinhole.mean_focal_px(),
                                                      configuration.pose, random, *workspace, pose, flags);
  std::vector<RayMatch> inliers;
  if (!status.ok()) return inliers;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (flags[i] == 0) continue;
    inliers.push_back(rays[i]);
    if (swap) std::swap(inliers.back().first, inliers.back().second);
  }
  return inliers;
}

void rectify_views(StageData& data) {
  const paper::RectificationParams params = data.session.configuration.rectification;
  OwnedWorkspace<paper::RectificationWorkspace> workspace(params);
  paper::PolarRectification rectification;
  if (!rectification
           .build({data.cutouts[0].camera, view_of(data.regions[0])},
                  {data.cutouts[1].camera, view_of(data.regions[1])}, data.other_from_reference, data.inliers,
                  params, *workspace)
           .ok()) {
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const int view = static_cast<int>(i);
    data.rectified[i].create(rectification.rows(), rectification.columns(view), CV_8U);
    data.rectified_regions[i].create(rectification.rows(), rectification.columns(view), CV_8U);
    rectification.rectify(view, view_of(data.working[i]), target_of(data.rectified[i]));
    rectification.rectify_labels(view, view_of(data.regions[i]), target_of(data.rectified_regions[i]));
  }
}

}  // namespace

StageData::StageData(const Scene& scene_) : scene(scene_), session(scene_), measurement(session.measure()) {
  const paper::Configuration& configuration = session.configuration;
  for (std::size_t i = 0; i < 2; ++i) {
    gray[i].create(scene.lens.height, scene.lens.width, CV_8U);
    convert_to_gray(scene.frames[i].frame(), target_of(gray[i]));
    features[i].picture = reduce_to_features(gray[i], scene.labels[i], configuration);
    find_features(configuration, features[i]);
  }
  rays = match_rays(features, scene.lens, configuration);
  const paper::WorkingPictures& pictures = session.estimator.pictures();
  const bool swap = measurement.views.reference_view == 1;
  inliers = find_inliers(rays, scene, configuration, swap);
  const Pose& motion = measurement.second_from_first;
  other_from_reference = swap ? motion.inverse() : motion;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t from = swap ? 1 - i : i;
    frames[i] = &scene.frames[from];
    working[i] = copy_of(pictures.gray[from]);
    working_labels[i] = copy_of(pictures.labels[from]);
    cutouts[i] = {pictures.cameras[from], working[i].cols, working[i].rows};
    regions[i] = (working_labels[i] >= kDishLabel) & (working_labels[i] <= kLastItemLabel);
  }
  rectify_views(*this);
}

}  // namespace traygauge::bench
