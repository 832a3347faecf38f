#include "core/paper/base/plane_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/ransac.hpp"

namespace traygauge::paper {
namespace {

constexpr std::size_t kPlaneSample = 3;

bool sample_plane(std::span<const Vec3> points, const PlaneFitParams& params, Random& random, Plane& plane) {
  const auto sample = sample_distinct<kPlaneSample>(random, points.size());
  const Vec3& a = points[sample[0]];
  const Vec3& b = points[sample[1]];
  const Vec3& c = points[sample[2]];
  const Vec3 normal = (b - a).cross(c - a);
  const double twice_area = normal.norm();
  if (!(twice_area > 2.0 * params.min_triangle_mm2)) return false;
  plane = plane_towards_camera(normal / twice_area, a);
  return -plane.offset >= params.min_facing_cosine * a.norm();
}

// Sum of min(distance², threshold²); counts the inliers.
double truncated_cost(std::span<const Vec3> points, const Plane& plane, double threshold, int& inliers) {
  const double limit = threshold * threshold;
  double cost = 0.0;
  inliers = 0;
  for (const Vec3& point : points) {
    const double height = plane.height(point);
    const double squared = height * height;
    inliers += squared < limit ? 1 : 0;
    cost += std::min(squared, limit);
  }
  return cost;
}

// Principal spreads of the points about their mean, ascending, and their directions.
Eigen::SelfAdjointEigenSolver<Mat3> measure_spread(std::span<const Vec3> points, Vec3& mean) {
  mean = Vec3::Zero();
  for (const Vec3& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Mat3 scatter = Mat3::Zero();
  for (const Vec3& point : points) scatter += (point - mean) * (point - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(scatter);
}

}  // namespace

bool fit_plane_least_squares(std::span<const Vec3> points_mm, Plane& plane) {
  if (points_mm.size() < kPlaneSample) return false;
  Vec3 mean;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver = measure_spread(points_mm, mean);
  // On a line two of the three spreads vanish.
  constexpr double kLineShare = 1e-12;
  if (!(solver.eigenvalues()[1] > kLineShare * solver.eigenvalues()[2])) return false;
  plane = plane_towards_camera(solver.eigenvectors().col(0), mean);
  return true;
}

bool fit_plane(std::span<Vec3> points_mm, const PlaneFitParams& params, Random& random, PlaneFit& fit) {
  fit = {};
  if (points_mm.size() < kPlaneSample) return false;
  Plane best;
  double best_cost = 0.0;
  int best_inliers = 0;
  IterationBound bound(params.confidence, params.min_iterations, params.max_iterations);
  for (; bound.proceed(); bound.count_iteration()) {
    Plane plane;
    if (!sample_plane(points_mm, params, random, plane)) continue;
    int inliers = 0;
    const double cost = truncated_cost(points_mm, plane, params.threshold_mm, inliers);
    if (best_inliers > 0 && cost >= best_cost) continue;
    best = plane;
    best_cost = cost;
    best_inliers = inliers;
    bound.update(inliers / static_cast<double>(points_mm.size()), kPlaneSample);
  }
  fit.iterations = bound.iterations();
  if (best_inliers < params.min_inliers) return false;

  const auto split = [&](const Plane& plane) {
    const auto end = std::partition(points_mm.begin(), points_mm.end(), [&](const Vec3& point) {
      return std::abs(plane.height(point)) < params.threshold_mm;
    });
    return points_mm.first(static_cast<std::size_t>(end - points_mm.begin()));
  };
  for (int i = 0; i < params.refits; ++i) {
    if (!fit_plane_least_squares(split(best), best)) return false;
  }
  const std::span<const Vec3> inliers = split(best);
  if (static_cast<int>(inliers.size()) < params.min_inliers) return false;
  double squares = 0.0;
  for (const Vec3& point : inliers) squares += best.height(point) * best.height(point);
  fit.plane = best;
  fit.inliers = static_cast<int>(inliers.size());
  const auto count = static_cast<double>(inliers.size());
  fit.rms_mm = std::sqrt(squares / count);
  Vec3 mean;
  fit.weak_spread_mm = std::sqrt(measure_spread(inliers, mean).eigenvalues()[1] / count);
  return true;
}

}  // namespace traygauge::paper
