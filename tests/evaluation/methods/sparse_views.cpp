#include "tests/evaluation/methods/sparse_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/geometry/triangulation.hpp"
#include "firmware/evaluate/statistics.hpp"
#include "tests/evaluation/methods/stopwatch.hpp"

namespace traygauge::tables {
namespace {

constexpr double kNormalDeviation = 1.4826;  // a normal distribution's standard deviation over its median one

std::vector<double> heights_of(std::span<const Vec3> points) {
  std::vector<double> heights;
  for (const Vec3& point : points) heights.push_back(point.z());
  return heights;
}

std::vector<Vec3> without_outliers(std::span<const Vec3> points, const TemplateParams& params) {
  const double middle = median(heights_of(points));
  std::vector<double> deviations;
  for (const Vec3& point : points) deviations.push_back(std::abs(point.z() - middle));
  const double limit = params.max_deviations * kNormalDeviation * median(deviations);
  std::vector<Vec3> kept;
  std::copy_if(points.begin(), points.end(), std::back_inserter(kept),
               [&](const Vec3& point) { return std::abs(point.z() - middle) <= limit; });
  return kept;
}

// The height at which the solid's surface passes through the middle of the points; NaN when none lies on it.
double height_by_points(const Solid& solid, std::span<const Vec3> points, const TemplateParams& params) {
  std::vector<double> heights;
  for (const Vec3& point : points) {
    const double share = relative_height(solid, point.head<2>());
    if (share >= params.min_relative_height) heights.push_back(point.z() / share);
  }
  return median(heights);
}

double mean_distance(const Solid& solid, std::span<const Vec3> points) {
  double sum = 0.0;
  for (const Vec3& point : points)
    sum += std::abs(point.z() - solid.height_mm * relative_height(solid, point.head<2>()));
  return sum / static_cast<double>(points.size());
}

std::uint8_t label_at(const paper::WorkingPictures& pictures, std::size_t view, const Vec2& ray) {
  const Vec2 pixel = pictures.cameras[view].pixel(ray);
  const auto x = static_cast<int>(std::lround(pixel.x()));
  const auto y = static_cast<int>(std::lround(pixel.y()));
  return pictures.labels[view].contains(x, y) ? pictures.labels[view].at(x, y) : std::uint8_t{0};
}

// By label, in the dish frame: those that lie on the same item in both views.
std::array<std::vector<Vec3>, 256> sort_points(const CalibratedPair& pair, const Pose& dish_from_camera) {
  std::array<std::vector<Vec3>, 256> sorted;
  for (const RayMatch& rays : pair.inliers) {
    const std::uint8_t label = label_at(pair.pictures, 0, rays.first);
    Vec3 point;
    if (label != label_at(pair.pictures, 1, rays.second) || !triangulate(rays, pair.second_from_first, point))
      continue;
    sorted.at(label).push_back(dish_from_camera * point);
  }
  return sorted;
}

}  // namespace

std::optional<Solid> fit_template(const ItemView& item, std::span<const Vec3> points,
                                  const TemplateParams& params) {
  if (points.size() < static_cast<std::size_t>(params.min_points)) return {};
  const std::vector<Vec3> kept = without_outliers(points, params);
  const double start_mm = quantile(heights_of(kept), 0.9);
  std::optional<Solid> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Template shape : kTemplates) {
    double height_mm = start_mm;
    Solid solid;
    for (int round = 0; round < params.rounds && height_mm > 0.0; ++round) {
      solid = fit_silhouette(item, shape, [&](double) { return height_mm; }).solid;
      height_mm = height_by_points(solid, kept, params);
    }
    if (!(height_mm > 0.0)) continue;
    solid.height_mm = height_mm;
    const double distance = mean_distance(solid, kept);
    if (distance >= least) continue;
    least = distance;
    best = solid;
  }
  return best;
}

Run measure_sparse_views(CaptureSession& session, const PairMatches& matches, std::uint64_t seed,
                         const TemplateParams& params) {
  Run run;
  run.seed = seed;
  const auto pair = calibrate_pair(session, matches, seed, run.status);
  if (!pair) return run;
  const Stopwatch watch;
  run.relative_angle_deg = pair->relative_angle_deg;
  const ImageView<const std::uint8_t> labels = pair->pictures.labels[0];
  const cv::Mat picture = as_cv(labels);
  ItemView item{
      pair->pictures.cameras[0], frame_on(pair->dish_bottom, pair->pictures.cameras[0], labels), {}};
  const auto points = sort_points(*pair, item.camera_from_dish.inverse());
  for (const std::uint8_t label : items_in(labels)) {
    item.mask = picture == label;
    const auto solid = fit_template(item, points.at(label), params);
    if (solid) {
      run.items.push_back({label, StatusCode::ok, volume_ml(*solid)});
    } else {
      run.items.push_back({label, StatusCode::item_textureless});
    }
  }
  conclude(run);
  run.total_ms = pair->time_ms + watch.elapsed_ms();
  return run;
}

}  // namespace traygauge::tables
