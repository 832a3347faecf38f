#include "tests/evaluation/methods/tray_geometry.hpp"

#include <algorithm>
#include <array>
#include <opencv2/calib3d.hpp>

#include "core/geometry/triangulation.hpp"
#include "core/labels/label_regions.hpp"
#include "core/paper/base/plane_fit.hpp"
#include "core/paper/pose/epipolar.hpp"
#include "tests/evaluation/methods/given_measurement.hpp"

namespace traygauge::tables {
namespace {

constexpr double kCardInlierShare = 0.03;  // of the card's length (paper III-A-3)
constexpr int kMinCardPoints = 8;

std::optional<RayMatch> rays_of(const CaptureSession& session, const Vec2& first, const Vec2& second) {
  RayMatch rays;
  if (!session.lens(0).undistort_pixel(first, rays.first)) return {};
  if (!session.lens(1).undistort_pixel(second, rays.second)) return {};
  return rays;
}

std::optional<Plane> print_in_cloud(const CaptureSession& session, const PairMatches& matches,
                                    const Pose& motion, std::uint64_t seed) {
  std::vector<Vec3> points;
  for (const paper::GivenCardMatch& match : matches.card_matches) {
    Vec3 point;
    const auto rays = rays_of(session, match.first, match.second);
    if (rays && triangulate(*rays, motion, point)) points.push_back(point);
  }
  Random random(seed);
  paper::PlaneFit fit;
  if (!paper::fit_plane(points, {}, random, fit)) return {};
  return fit.plane;
}

double calibration_ms(const Measurement& measurement) {
  double sum = 0.0;
  for (std::size_t stage = 0; stage <= static_cast<std::size_t>(Stage::scale); ++stage)
    sum += measurement.stage_ms[stage];
  return sum;
}

}  // namespace

std::optional<CalibratedPair> calibrate_pair(CaptureSession& session, const PairMatches& matches,
                                             std::uint64_t seed, StatusCode& refusal) {
  const Measurement& measurement = measure_given(session, matches, seed);
  refusal = measurement.status.code();
  const bool has_angle = refusal != StatusCode::views_too_close && refusal != StatusCode::views_too_far_apart;
  if (!measurement.has_pose || !has_angle) return {};
  CalibratedPair pair;
  pair.second_from_first = measurement.second_from_first;
  pair.pictures = *session.pictures();
  pair.relative_angle_deg = measurement.relative_angle_deg;
  pair.time_ms = matches.time_ms + calibration_ms(measurement);
  refusal = StatusCode::table_not_found;
  const auto print = print_in_cloud(session, matches, pair.second_from_first, seed);
  if (!print) return {};
  refusal = StatusCode::dish_unknown;
  const auto bottom = bottom_under_print(session, *print);
  if (!bottom) return {};
  pair.dish_bottom = *bottom;
  const double focal_px =
      0.5 * (session.lens(0).pinhole.mean_focal_px() + session.lens(1).pinhole.mean_focal_px());
  const Mat3 essential = essential_matrix(pair.second_from_first);
  for (const paper::GivenMatch& match : matches.matches) {
    const auto rays = rays_of(session, match.first, match.second);
    if (rays && paper::symmetric_epipolar_distance_px(essential, *rays, focal_px) <=
                    measurement.report.inlier_threshold_px)
      pair.inliers.push_back(*rays);
  }
  refusal = StatusCode::ok;
  return pair;
}

std::optional<Plane> find_card_plane(const CaptureSession& session, int view, const PointFeatures& points,
                                     const PointFeatures& pattern) {
  const double ratio = static_cast<double>(paper::MatcherParams{}.distinctiveness_ratio);
  std::vector<cv::Point2d> rays;
  std::vector<cv::Point2d> printed;
  for (const IndexPair& pair : match_points(points, pattern, Detector::sift, ratio)) {
    Vec2 ray;
    if (!session.lens(view).undistort_pixel(points.pixels[static_cast<std::size_t>(pair.first)], ray))
      continue;
    const Vec2& place = pattern.pixels[static_cast<std::size_t>(pair.second)];
    rays.emplace_back(ray.x(), ray.y());
    printed.emplace_back(place.x(), place.y());
  }
  if (rays.size() < kMinCardPoints) return {};
  const CardDescription& card = session.setup().card;
  std::vector<std::uint8_t> inliers;
  const cv::Mat homography = cv::findHomography(
      rays, printed, cv::RANSAC, kCardInlierShare * std::max(card.width_mm, card.height_mm), inliers);
  if (homography.empty()) return {};
  std::vector<cv::Point3d> points_mm;
  std::vector<cv::Point2d> seen;
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    if (inliers[i] == 0) continue;
    points_mm.emplace_back(printed[i].x, printed[i].y, 0.0);
    seen.push_back(rays[i]);
  }
  if (seen.size() < kMinCardPoints) return {};
  cv::Vec3d turn;
  cv::Vec3d origin;
  if (!cv::solvePnP(points_mm, seen, cv::Matx33d::eye(), cv::noArray(), turn, origin, false,
                    cv::SOLVEPNP_IPPE))
    return {};
  cv::solvePnPRefineLM(points_mm, seen, cv::Matx33d::eye(), cv::noArray(), turn, origin);
  cv::Matx33d rotation;
  cv::Rodrigues(turn, rotation);
  return plane_towards_camera(Vec3(rotation(0, 2), rotation(1, 2), rotation(2, 2)),
                              Vec3(origin[0], origin[1], origin[2]));
}

std::optional<Plane> bottom_under_print(const CaptureSession& session, const Plane& print) {
  const PairSetup& setup = session.setup();
  if (setup.dishes.size() != 1) return {};
  return print.raised(setup.dishes.front().bottom_height_mm - setup.card.thickness_mm);
}

Pose frame_on(const Plane& bottom, const PinholeCamera& camera, ImageView<const std::uint8_t> picture) {
  const Vec3 sight = camera.ray(Vec2(0.5 * picture.width, 0.5 * picture.height)).homogeneous();
  const Vec3 origin = sight * (bottom.offset / bottom.normal.dot(sight));
  Mat3 axes;
  axes.col(2) = bottom.normal;
  axes.col(0) = (Vec3::UnitX() - bottom.normal.x() * bottom.normal).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return {axes, origin};
}

cv::Mat as_cv(ImageView<const std::uint8_t> picture) {
  return {picture.height, picture.width, CV_8UC1, const_cast<std::uint8_t*>(picture.data),
          static_cast<std::size_t>(picture.stride)};
}

std::vector<std::uint8_t> items_in(ImageView<const std::uint8_t> labels) {
  const LabelRegions regions = measure_regions(labels);
  const auto min_px = static_cast<std::uint32_t>(paper::VolumeExtractionParams{}.min_item_px);
  std::vector<std::uint8_t> items;
  for (int label = kFirstItemLabel; label <= kLastItemLabel; ++label) {
    if (regions.pixels[static_cast<std::size_t>(label)] >= min_px)
      items.push_back(static_cast<std::uint8_t>(label));
  }
  return items;
}

void conclude(Run& run) {
  const auto measured = std::count_if(run.items.begin(), run.items.end(),
                                      [](const ItemEstimate& item) { return item.status == StatusCode::ok; });
  if (run.items.empty()) {
    run.status = StatusCode::item_too_small;
  } else if (measured == 0) {
    run.status = run.items.front().status;
  } else {
    const bool is_all = measured == static_cast<std::ptrdiff_t>(run.items.size());
    run.status = is_all ? StatusCode::ok : StatusCode::partial;
  }
}

}  // namespace traygauge::tables
