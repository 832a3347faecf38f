#include "core/paper/surface/rim.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace traygauge::paper {
namespace {

constexpr std::size_t kBlockSides = RimWorkspace::kBlockSides;
constexpr int kNewtonSteps = 3;
constexpr double kCrestInset_px = 3.0;  // so far inside the border lies the rim's crest, clear of the table

// Line of a picture: normal · (x, y) + offset = 0.
struct PixelLine {
  Vec2 normal = Vec2::Zero();
  double offset = 0.0;

  double value(const Vec2& pixel) const { return normal.dot(pixel) + offset; }
};

// The picture line of the plane with this normal through the camera's centre.
PixelLine project_plane(const Vec3& plane_normal, const PinholeCamera& camera) {
  const Vec2 normal(plane_normal.x() / camera.fx_px, plane_normal.y() / camera.fy_px);
  const double offset = plane_normal.z() - normal.dot(Vec2(camera.cx_px, camera.cy_px));
  const double scale = 1.0 / normal.norm();
  return {normal * scale, offset * scale};
}

Vec3 homogeneous_ray(const PinholeCamera& camera, const Vec2& pixel) {
  const Vec2 ray = camera.ray(pixel);
  return {ray.x(), ray.y(), 1.0};
}

// Where a smooth border crosses a line near a side; false when it does not within the fitted stretch.
bool cross_curve(const ContourCurve& curve, const PixelLine& line, double reach_px, double& u) {
  u = 0.0;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Vec3& c = curve.coefficients;
    const double slope = line.normal.dot(curve.tangent + (c[1] + 2.0 * u * c[2]) * curve.inward);
    u -= line.value(curve.point(u)) / slope;
    if (!(std::abs(u) <= reach_px)) return false;
  }
  return true;
}

// Matches a point of the first border to the second border.
class ContourMatcher {
 public:
  ContourMatcher(const RimInput& input, const RimParams& params, const RimWorkspace& workspace)
      : cameras_(input.cameras),
        params_(params),
        first_(workspace.first),
        second_(workspace.second),
        blocks_(workspace.second_blocks.items()) {}

  bool match(std::size_t first_side, Vec3& point_mm) const {
    ContourCurve curve;
    if (!fit_contour_curve(first_, first_side, params_.curve, curve)) return false;
    const Pose& pose = cameras_.second_from_first;
    const Vec3 ray = homogeneous_ray(cameras_.first, curve.point(0.0));
    const Vec3 rotated = pose.rotation * ray;
    const Vec3 epipolar_normal = pose.translation.cross(rotated);
    const PixelLine first_line = project_plane(pose.rotation.transpose() * epipolar_normal, cameras_.first);
    const double sine = first_line.normal.dot(curve.direction(0.0));
    if (!(std::abs(sine) >= params_.min_crossing_sine)) return false;

    Vec2 second_pixel;
    if (!find_crossing(project_plane(epipolar_normal, cameras_.second), sine > 0.0, second_pixel))
      return false;
    double depth = 0.0;
    if (!triangulate_depth(rotated, homogeneous_ray(cameras_.second, second_pixel), pose.translation,
                           depth)) {
      return false;
    }
    point_mm = ray * depth;
    return true;
  }

 private:
  // Both walks run clockwise and the epipolar plane turns the same way in both views, so the same rim point
  // crosses it in the same sense: that tells the near side from the far side. More than one such crossing is
  // ambiguous and gives none.
  bool find_crossing(const PixelLine& line, bool rising, Vec2& pixel) const {
    const std::size_t blocks = blocks_.size();
    if (blocks < 3) return false;
    double previous = line.value(blocks_[blocks - 1]);
    std::size_t found = blocks;
    double share = 0.0;
    for (std::size_t block = 0; block < blocks; ++block) {
      const double value = line.value(blocks_[block]);
      const bool is_crossing = rising ? (previous < 0.0 && value >= 0.0) : (previous >= 0.0 && value < 0.0);
      if (is_crossing) {
        if (found != blocks) return false;
        found = block;
        share = value / (value - previous);
      }
      previous = value;
    }
    if (found == blocks) return false;
    const auto back = static_cast<std::size_t>(share * kBlockSides);
    const std::size_t size = second_.sides.size();
    return refine_crossing(line, (found * kBlockSides + kBlockSides / 2 + size - back) % size, pixel);
  }

  bool refine_crossing(const PixelLine& line, std::size_t side, Vec2& pixel) const {
    ContourCurve curve;
    if (!fit_contour_curve(second_, side, params_.curve, curve)) return false;
    double u = 0.0;
    if (!cross_curve(curve, line, params_.curve.radius_sides, u)) return false;
    pixel = curve.point(u);
    return std::abs(line.normal.dot(curve.direction(u))) >= params_.min_crossing_sine;
  }

  const CameraPair& cameras_;
  const RimParams& params_;
  const DishContour& first_;
  const DishContour& second_;
  std::span<const Vec2> blocks_;
};

void average_blocks(const DishContour& contour, BoundedList<Vec2>& blocks) {
  blocks.clear();
  for (std::size_t side = 0; side + kBlockSides <= contour.sides.size(); side += kBlockSides) {
    Vec2 sum = Vec2::Zero();
    for (std::size_t k = 0; k < kBlockSides; ++k) sum += contour.place(side + k);
    blocks.push_back(sum / static_cast<double>(kBlockSides));
  }
}

// The measured depth at the rim's crest.
bool unproject_crest(ImageView<const float> depth_mm, const PinholeCamera& camera,
                     const ContourFitParams& params, const DishContour& contour, std::size_t side,
                     Vec3& point_mm) {
  ContourCurve curve;
  if (!fit_contour_curve(contour, side, params, curve)) return false;
  const Vec2 place = curve.point(0.0) + kCrestInset_px * curve.inward;
  const int x = static_cast<int>(std::lround(place.x()));
  const int y = static_cast<int>(std::lround(place.y()));
  if (!depth_mm.contains(x, y)) return false;
  const double depth = depth_mm.at(x, y);
  if (!(depth > 0.0)) return false;
  point_mm = homogeneous_ray(camera, Vec2(x, y)) * depth;
  return true;
}

Status judge_count(const BoundedList<Vec3>& points_mm, const RimParams& params) {
  const bool is_enough = points_mm.size() >= static_cast<std::size_t>(params.plane.min_inliers);
  return is_enough ? StatusCode::ok : StatusCode::rim_not_found;
}

// Moves the points to the front whose line of sight from both cameras comes from inside the dish, or from
// outside at a tangent of at most `limit`; returns their number.
std::size_t count_outer_edge(std::span<Vec3> points_mm, const Plane& rim, const Vec3& second_centre,
                             double limit) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& point : points_mm) centre += point;
  centre /= static_cast<double>(points_mm.size());
  const auto is_edge = [&](const Vec3& point) {
    const Vec3 radius = point - centre;
    const Vec3 outward = (radius - rim.normal * rim.normal.dot(radius)).normalized();
    const auto tangent = [&](const Vec3& camera) {
      return outward.dot(camera - point) / rim.normal.dot(camera - point);
    };
    return tangent(Vec3::Zero()) <= limit && tangent(second_centre) <= limit;
  };
  return static_cast<std::size_t>(std::partition(points_mm.begin(), points_mm.end(), is_edge) -
                                  points_mm.begin());
}

}  // namespace

Status collect_rim_points(const RimInput& input, const RimParams& params, RimWorkspace& workspace) {
  workspace.points_mm.clear();
  const Status first = trace_dish_contour(input.first_labels, workspace.first);
  if (!first.ok()) return first;
  const Status second = trace_dish_contour(input.second_labels, workspace.second);
  if (!second.ok()) return second;
  average_blocks(workspace.second, workspace.second_blocks);
  const ContourMatcher matcher(input, params, workspace);
  const auto step = static_cast<std::size_t>(params.step_sides);
  Vec3 point_mm;
  for (std::size_t side = 0; side < workspace.first.sides.size(); side += step) {
    if (matcher.match(side, point_mm)) workspace.points_mm.push_back(point_mm);
  }
  return judge_count(workspace.points_mm, params);
}

Status collect_rim_crest(ImageView<const std::uint8_t> labels, ImageView<const float> depth_mm,
                         const PinholeCamera& camera, const RimParams& params, RimWorkspace& workspace) {
  workspace.points_mm.clear();
  const Status traced = trace_dish_contour(labels, workspace.first);
  if (!traced.ok()) return traced;
  const auto step = static_cast<std::size_t>(params.step_sides);
  Vec3 point_mm;
  for (std::size_t side = 0; side < workspace.first.sides.size(); side += step) {
    if (unproject_crest(depth_mm, camera, params.curve, workspace.first, side, point_mm)) {
      workspace.points_mm.push_back(point_mm);
    }
  }
  return judge_count(workspace.points_mm, params);
}

double tilt_sigma_rad(const PlaneFit& fit, const RimParams& params) {
  const double overlap = (2.0 * params.curve.radius_sides + 1.0) / params.step_sides;
  const double independent = fit.inliers / std::max(1.0, overlap);
  return fit.rms_mm / (fit.weak_spread_mm * std::sqrt(independent));
}

Status fit_rim_plane(const Pose& second_from_first, const RimParams& params, Random& random,
                     BoundedList<Vec3>& points_mm, PlaneFit& fit) {
  if (!fit_plane(points_mm.items(), params.plane, random, fit)) return StatusCode::rim_not_found;
  points_mm.truncate(static_cast<std::size_t>(fit.inliers));

  const Vec3 second_centre = second_from_first.inverse().translation;
  const std::size_t edge_points =
      count_outer_edge(points_mm.items(), fit.plane, second_centre, params.max_outward_tangent);
  if (edge_points <
      std::max<std::size_t>(static_cast<std::size_t>(params.plane.min_inliers), points_mm.size() / 3)) {
    return StatusCode::ok;
  }
  PlaneFit edge_fit;
  if (!fit_plane(points_mm.items().first(edge_points), params.plane, random, edge_fit)) return StatusCode::ok;
  if (tilt_sigma_rad(edge_fit, params) > params.max_edge_sigma_rad) return StatusCode::ok;
  edge_fit.iterations += fit.iterations;
  fit = edge_fit;
  return StatusCode::ok;
}

}  // namespace traygauge::paper
