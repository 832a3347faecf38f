#include "core/tracking/pose_correction.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"

namespace traygauge {
namespace {

using Equations = NormalEquations<6>;
using Step = Equations::Vector;

constexpr double kScaleFactor = 3.0;  // between two scales: 20, 6.7 and 2.2 px before the finest

// Residuals of one point: two when its height is known, else one.
struct PointResiduals {
  int count = 0;
  double values_px[2] = {0.0, 0.0};
  Step jacobians[2] = {Step::Zero(), Step::Zero()};
  double squared_px() const { return values_px[0] * values_px[0] + values_px[1] * values_px[1]; }
};

struct CorrectionState {
  Pose second_from_table;
  Step since_start = Step::Zero();  // the sum of the steps, which the prior holds
};

class CorrectionProblem {
 public:
  CorrectionProblem(std::span<const SeenPoint> points, const Pose& first_from_table, double focal_px,
                    double scale_px, const PoseCorrectionParams& params)
      : points_(points),
        table_from_first_(first_from_table.inverse()),
        focal_px_(focal_px),
        inverse_squared_scale_(1.0 / (scale_px * scale_px)) {
    const double turn = params.turn_sigma_deg * kRadiansPerDegree;
    information_.head<3>().setConstant(1.0 / (turn * turn));
    information_.tail<3>().setConstant(1.0 / (params.shift_sigma_mm * params.shift_sigma_mm));
  }

  double linearise(const CorrectionState& state, Equations& equations) const {
    double total = prior_cost(state);
    for (int i = 0; i < 6; ++i) {
      equations.gradient[i] += information_[i] * state.since_start[i];
      equations.hessian(i, i) += information_[i];
    }
    const Pose second_from_first = state.second_from_table * table_from_first_;
    for (const SeenPoint& point : points_) {
      const PointResiduals residuals = residuals_of(point, state.second_from_table, second_from_first);
      const double shrink = 1.0 / (1.0 + residuals.squared_px() * inverse_squared_scale_);
      total += residuals.squared_px() * shrink;
      for (int i = 0; i < residuals.count; ++i)
        equations.add(residuals.values_px[i], residuals.jacobians[i], shrink * shrink);
    }
    return total;
  }

  double cost(const CorrectionState& state) const {
    double total = prior_cost(state);
    const Pose second_from_first = state.second_from_table * table_from_first_;
    for (const SeenPoint& point : points_) {
      const double square = residuals_of(point, state.second_from_table, second_from_first).squared_px();
      total += square / (1.0 + square * inverse_squared_scale_);
    }
    return total;
  }

  static CorrectionState moved(const CorrectionState& state, const Step& step) {
    return {traygauge::moved(state.second_from_table, step), state.since_start + step};
  }

 private:
  double prior_cost(const CorrectionState& state) const {
    double total = 0.0;
    for (int i = 0; i < 6; ++i) total += information_[i] * state.since_start[i] * state.since_start[i];
    return total;
  }

  PointResiduals residuals_of(const SeenPoint& point, const Pose& second_from_table,
                              const Pose& second_from_first) const {
    return point.height_known ? place_residuals(point, second_from_table)
                              : line_residual(point, second_from_table, second_from_first);
  }

  PointResiduals place_residuals(const SeenPoint& point, const Pose& second_from_table) const {
    PointResiduals result;
    const Vec3 turned = second_from_table.rotation * point.table_mm;
    const Vec3 seen = turned + second_from_table.translation;
    if (!(seen.z() > kNearMm)) return result;
    result.count = 2;
    for (int i = 0; i < 2; ++i) {
      const double ray = seen[i] / seen.z();
      result.values_px[i] = focal_px_ * (ray - point.second[i]);
      // By the point as seen; turning moves it by turn × turned.
      Vec3 by_seen = Vec3::Zero();
      by_seen[i] = focal_px_ / seen.z();
      by_seen.z() = -focal_px_ * ray / seen.z();
      result.jacobians[i].head<3>() = turned.cross(by_seen);
      result.jacobians[i].tail<3>() = by_seen;
    }
    return result;
  }

  // x₂ · (t × y) over its gradient's length, y = R x₁ and (R, t) second_from_first. The length varies with t:
  // were it held, a shorter motion would seem to bring points nearer to their lines.
  PointResiduals line_residual(const SeenPoint& point, const Pose& second_from_table,
                               const Pose& second_from_first) const {
    PointResiduals result;
    const Vec3 y = second_from_first.rotation * Vec3(point.first.x(), point.first.y(), 1.0);
    const Vec3 x2(point.second.x(), point.second.y(), 1.0);
    const Vec3 line = second_from_first.translation.cross(y);
    const double length = line.head<2>().norm();
    if (!(length > 0.0)) return result;
    const double scale = focal_px_ / length;
    // x₂'s foot on the line: r = s/l moves by (ds − r dl)/l, which is ds/l taken at the foot.
    const Vec3 foot = x2 - x2.dot(line) / (length * length) * Vec3(line.x(), line.y(), 0.0);
    const Vec3 by_translation = scale * y.cross(foot);
    // t = t₂ + turn × (R t₁) …: what of t turns with the second camera.
    const Vec3 turned = second_from_first.translation - second_from_table.translation;
    result.count = 1;
    result.values_px[0] = scale * x2.dot(line);
    result.jacobians[0].head<3>() =
        scale * y.cross(foot.cross(second_from_first.translation)) + turned.cross(by_translation);
    result.jacobians[0].tail<3>() = by_translation;
    return result;
  }

  std::span<const SeenPoint> points_;
  Pose table_from_first_;
  double focal_px_;
  double inverse_squared_scale_;
  Step information_;
};

}  // namespace

void correct_second_pose(std::span<const SeenPoint> points, double focal_px,
                         const PoseCorrectionParams& params, TableCameras& camera_from_table) {
  CorrectionState state{camera_from_table[1]};
  LevenbergMarquardtParams minimisation;
  minimisation.max_iterations = params.max_iterations;
  minimisation.min_improvement = 1e-4;
  double scale_px = std::max(params.coarsest_scale_px, params.finest_scale_px);
  for (int round = 0; round < 8; ++round) {
    minimise<6>(CorrectionProblem(points, camera_from_table[0], focal_px, scale_px, params), minimisation,
                state);
    if (scale_px <= params.finest_scale_px) break;
    scale_px = std::max(scale_px / kScaleFactor, params.finest_scale_px);
  }
  if (state.second_from_table.rotation.allFinite() && state.second_from_table.translation.allFinite())
    camera_from_table[1] = state.second_from_table;
}

}  // namespace traygauge
