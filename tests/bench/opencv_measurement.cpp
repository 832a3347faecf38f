#include "tests/bench/opencv_measurement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/labels/label_regions.hpp"
#include "tests/bench/comparisons.hpp"
#include "tests/bench/opencv_stereo.hpp"

namespace traygauge::bench {
namespace {

constexpr int kPeerSiftPoints = 4000;
constexpr double kDishPixels = 400000.0;  // where SIFT looks
constexpr int kCardSidePx = 520;
constexpr float kRatio = 0.8F;

struct PeerView {
  cv::Mat gray;
  cv::Mat labels;
  SparsePoints points;
  std::vector<cv::Point2d> rays;
  OpenCvCard card;
};

std::vector<cv::Point2d> undistort(const std::vector<cv::Point2d>& pixels, const OpenCvLens& lens) {
  std::vector<cv::Point2d> rays;
  if (!pixels.empty()) cv::undistortPoints(pixels, rays, lens.camera, lens.distortion);
  return rays;
}

cv::Point3d on_card(const OpenCvPattern& pattern, int point) {
  const cv::Point2d& pixel = pattern.points.pixels[static_cast<std::size_t>(point)];
  return {(pixel.x + 0.5) / pattern.px_per_mm, (pixel.y + 0.5) / pattern.px_per_mm, 0.0};
}

bool prepare_view(const Scene& scene, std::size_t i, const OpenCvPattern& pattern, const OpenCvLens& lens,
                  PeerView& view) {
  const Picture& frame = scene.frames[i];
  const cv::Mat pixels(frame.size.height, frame.size.width,
                       frame.format == PixelFormat::gray8 ? CV_8U : CV_8UC3,
                       const_cast<std::uint8_t*>(frame.pixels.data()));
  if (frame.format == PixelFormat::gray8) {
    view.gray = pixels;
  } else {
    cv::cvtColor(pixels, view.gray,
                 frame.format == PixelFormat::rgb8 ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
  }
  view.labels = cv::Mat(frame.size.height, frame.size.width, CV_8U,
                        const_cast<std::uint8_t*>(scene.labels[i].pixels.data()));
  const LabelRegions regions = measure_regions(scene.labels[i].gray());
  if (regions.dish.empty() || regions.card.empty()) return false;
  const cv::Rect box = as_rect(regions.dish) | as_rect(regions.card);
  view.points = find_sift(view.gray, box, std::sqrt(kDishPixels / regions.dish_pixels), kPeerSiftPoints);
  view.rays = undistort(view.points.pixels, lens);
  return find_card(view.gray, as_rect(regions.card), pattern, lens, view.card);
}

// The motion of the camera up to scale, and the rays that agree with it.
struct PeerMotion {
  cv::Mat rotation;
  cv::Mat translation;
  std::vector<cv::Point2d> first;
  std::vector<cv::Point2d> second;
  std::vector<cv::Point2d> first_pixels;
};

bool find_motion(const PeerView& first, const PeerView& second, double focal_px, PeerMotion& motion) {
  cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<cv::Point2d> a;
  std::vector<cv::Point2d> b;
  const auto pairs = match_symmetric(matcher, first.points.descriptors, second.points.descriptors, kRatio);
  for (const cv::Point& pair : pairs) {
    a.push_back(first.rays[static_cast<std::size_t>(pair.x)]);
    b.push_back(second.rays[static_cast<std::size_t>(pair.y)]);
  }
  if (a.size() < 16) return false;
  int most = 0;
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  for (const int method : std::array<int, 2>{cv::USAC_MAGSAC, cv::RANSAC}) {
    std::vector<std::uint8_t> inlier;
    cv::Mat rotation;
    cv::Mat translation;
    const cv::Mat essential = cv::findEssentialMat(a, b, identity, method, 0.9999, 0.7 / focal_px, inlier);
    if (essential.rows != 3) continue;
    const int count = cv::recoverPose(essential, a, b, identity, rotation, translation, inlier);
    if (count <= most) continue;
    most = count;
    motion = {rotation, translation, {}, {}, {}};
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (inlier[i] == 0) continue;
      motion.first.push_back(a[i]);
      motion.second.push_back(b[i]);
      motion.first_pixels.push_back(first.points.pixels[static_cast<std::size_t>(pairs[i].x)]);
    }
  }
  return most >= 16;
}

std::vector<cv::Vec3d> triangulate(const PeerMotion& motion, const std::vector<cv::Point2d>& first,
                                   const std::vector<cv::Point2d>& second) {
  cv::Mat second_projection;
  cv::hconcat(motion.rotation, motion.translation, second_projection);
  cv::Mat points;
  cv::triangulatePoints(cv::Mat::eye(3, 4, CV_64F), second_projection, first, second, points);
  std::vector<cv::Vec3d> result;
  for (int i = 0; i < points.cols; ++i) {
    const double w = points.at<double>(3, i);
    result.emplace_back(points.at<double>(0, i) / w, points.at<double>(1, i) / w,
                        points.at<double>(2, i) / w);
  }
  return result;
}

// mm per unit of the motion: the median ratio of the distances between points of the card in both views.
double scale_by_card(const PeerMotion& motion, const PeerView& first, const PeerView& second,
                     const OpenCvPattern& pattern) {
  std::vector<cv::Point2d> a;
  std::vector<cv::Point2d> b;
  std::vector<cv::Point3d> printed;
  for (const auto& [point, ray] : first.card.rays) {
    const auto found = second.card.rays.find(point);
    if (found == second.card.rays.end()) continue;
    a.push_back(ray);
    b.push_back(found->second);
    printed.push_back(on_card(pattern, point));
  }
  if (a.size() < 4) return 0.0;
  const std::vector<cv::Vec3d> points = triangulate(motion, a, b);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double true_mm = cv::norm(printed[i] - printed[j]);
      if (true_mm > 20.0) ratios.push_back(true_mm / cv::norm(points[i] - points[j]));
    }
  }
  if (ratios.empty()) return 0.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

}  // namespace

OpenCvPattern prepare_pattern(const Scene& scene) {
  const Picture& pattern = scene.pattern;
  const cv::Mat picture(pattern.size.height, pattern.size.width, CV_8U,
                        const_cast<std::uint8_t*>(pattern.pixels.data()));
  const double scale = std::min(1.0, static_cast<double>(kCardSidePx) / pattern.size.width);
  return {find_sift(picture, {0, 0, picture.cols, picture.rows}, scale, kPeerSiftPoints),
          pattern.size.width / scene.card.width_mm};
}

bool find_card(const cv::Mat& gray, const cv::Rect& box, const OpenCvPattern& pattern, const OpenCvLens& lens,
               OpenCvCard& card) {
  const double scale = std::min(1.0, static_cast<double>(kCardSidePx) / std::max(box.width, box.height));
  const SparsePoints points = find_sift(gray, box, scale, kPeerSiftPoints);
  cv::BFMatcher matcher(cv::NORM_L2);
  const auto pairs = match_symmetric(matcher, points.descriptors, pattern.points.descriptors, kRatio);
  if (pairs.size() < 8) return false;
  std::vector<cv::Point2d> seen;
  std::vector<cv::Point2d> printed;
  for (const cv::Point& pair : pairs) {
    seen.push_back(points.pixels[static_cast<std::size_t>(pair.x)]);
    const cv::Point3d place = on_card(pattern, pair.y);
    printed.emplace_back(place.x, place.y);
  }
  const std::vector<cv::Point2d> rays = undistort(seen, lens);
  std::vector<std::uint8_t> inlier;
  cv::findHomography(printed, rays, inlier, cv::USAC_MAGSAC, 2.0 / lens.camera(0, 0));
  std::vector<cv::Point3d> card_points;
  std::vector<cv::Point2d> card_rays;
  for (std::size_t i = 0; i < inlier.size(); ++i) {
    if (inlier[i] == 0) continue;
    card.rays[pairs[i].y] = rays[i];
    card_points.push_back(on_card(pattern, pairs[i].y));
    card_rays.push_back(rays[i]);
  }
  if (card_points.size() < 8) return false;
  cv::Vec3d turn;
  if (!cv::solvePnP(card_points, card_rays, cv::Matx33d::eye(), cv::noArray(), turn, card.origin_mm, false,
                    cv::SOLVEPNP_IPPE))
    return false;
  cv::solvePnPRefineLM(card_points, card_rays, cv::Matx33d::eye(), cv::noArray(), turn, card.origin_mm);
  cv::Rodrigues(turn, card.rotation);
  return true;
}

std::map<int, double> measure_by_opencv(const Scene& scene, const OpenCvPattern& pattern) {
  cv::setRNGSeed(1);
  const OpenCvLens lens(scene.lens);
  std::array<PeerView, 2> views;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!prepare_view(scene, i, pattern, lens, views[i])) return {};
  }
  PeerMotion motion;
  if (!find_motion(views[0], views[1], lens.camera(0, 0), motion)) return {};
  const double mm = scale_by_card(motion, views[0], views[1], pattern);
  if (!(mm > 0.0)) return {};

  OpenCvStereoInput input;
  input.gray = {views[0].gray, views[1].gray};
  input.labels = {views[0].labels, views[1].labels};
  input.rotation = cv::Matx33d(motion.rotation);
  input.translation = cv::Vec3d(motion.translation) * mm;
  const auto up_axis = [](const cv::Matx33d& r) { return -cv::Vec3d(r(0, 2), r(1, 2), r(2, 2)); };
  // The print seen from both views; y of the pattern runs down, so its z points into the table.
  input.bottom_normal =
      cv::normalize(up_axis(views[0].card.rotation) + input.rotation.t() * up_axis(views[1].card.rotation));
  const cv::Vec3d card = views[0].card.origin_mm;
  input.bottom_offset = input.bottom_normal.dot(card) - scene.card.thickness_mm + scene.dish.bottom_height_mm;
  const std::vector<cv::Vec3d> cloud = triangulate(motion, motion.first, motion.second);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const cv::Point place(motion.first_pixels[i]);
    const std::uint8_t label = views[0].labels.at<std::uint8_t>(std::clamp(place.y, 0, scene.lens.height - 1),
                                                                std::clamp(place.x, 0, scene.lens.width - 1));
    if (is_on_dish(label)) input.dish_points.push_back(cloud[i] * mm);
  }
  std::map<int, double> volumes_ml = volumes_by_sgbm(input, lens);
  for (const auto& [label, ml] : volumes_by_sgbm(input.swapped(), lens)) {
    auto& mean = volumes_ml[label];
    mean = mean == 0.0 ? ml : 0.5 * (mean + ml);
  }
  return volumes_ml;
}

}  // namespace traygauge::bench
