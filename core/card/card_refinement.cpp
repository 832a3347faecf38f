#include "core/card/card_refinement.hpp"

#include <algorithm>
#include <cmath>

#include "core/card/card_hypotheses.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/geometry/table_frame.hpp"

namespace traygauge {
namespace {

constexpr double kDamping = 1e-6;  // of Gauss and Newton's step, relative: keeps flat directions still

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

// The inverse of a positive definite matrix, of which the lower triangle is read, column by column: Eigen's
// own solvers of this size refer to the heap.
template <int kSize>
bool invert(const Eigen::Matrix<double, kSize, kSize>& matrix, Eigen::Matrix<double, kSize, kSize>& inverse) {
  NormalEquations<kSize> equations;
  equations.hessian = matrix;
  for (int i = 0; i < kSize; ++i) {
    typename NormalEquations<kSize>::Vector column;
    equations.gradient = -NormalEquations<kSize>::Vector::Unit(i);
    if (!equations.solve(0.0, column)) return false;
    inverse.col(i) = column;
  }
  return true;
}

}  // namespace

bool CardRefinement::is_possible(const Pose& camera_from_table) const {
  const Vec3 centre = camera_from_table * centre_mm();
  if (!camera_from_table.rotation.allFinite() || !centre.allFinite()) return false;
  const Vec3 normal = camera_from_table.rotation.col(2);
  return centre.z() > 0.0 && -normal.dot(centre) > kMinCardCosine * centre.norm();
}

const CardPatternLevel& CardRefinement::level_for(const Pose& camera_from_table, double blur_px) const {
  return pattern_.nearest_level(blur_px / px_per_mm(camera_from_table));
}

double CardRefinement::blur_px(const Pose& camera_from_table, const CardPatternLevel& level) const {
  return level.blur_mm * px_per_mm(camera_from_table);
}

void CardRefinement::select(const Pose& camera_from_table, const CardPatternLevel& level) {
  picture_.select(camera_from_table, pattern_.size, 2.0 * level.blur_mm + 1.0 / px_per_mm(camera_from_table));
}

bool CardRefinement::refine(const CardPatternLevel& level, CardSampling sampling, int iterations,
                            CardFitState& state) const {
  const CardCorrelation start = correlate(state.camera_from_table, level, sampling);
  if (start.samples < params_.min_samples) return false;
  state.tone = start.tone;
  state.spread_gray = start.rms_gray;
  for (int i = 0; i < iterations; ++i) {
    const CardLinearisation linearised = linearise(level, sampling, state);
    Vector12 change;
    if (!linearised.equations.solve(kDamping, change)) return false;
    const double motion_px =
        corner_motion_px(state.camera_from_table, moved(state.camera_from_table, change.head<6>()));
    if (!std::isfinite(motion_px)) return false;
    if (motion_px > params_.max_step_px) change *= params_.max_step_px / motion_px;
    state.camera_from_table = moved(state.camera_from_table, change.head<6>());
    state.tone += change.tail<6>();
    state.spread_gray = linearised.spread_gray;
    if (!is_possible(state.camera_from_table)) return false;
    if (motion_px < params_.converged_px) break;
  }
  return true;
}

bool CardRefinement::inform(const CardPatternLevel& level, CardSampling sampling, CardFitState& state,
                            PoseInformation& information) const {
  const CardLinearisation linearised = linearise(level, sampling, state);
  state.spread_gray = linearised.spread_gray;
  Matrix12 inverse;
  PoseInformation by_corners;
  // Falling weights flatten the cost: its curvature is that much below the normal equations.
  const double curvature = linearised.slopes / linearised.weights;
  if (!(curvature > 0.0) || !invert(linearised.equations.hessian, inverse)) return false;
  if (!invert(corner_information(state.camera_from_table), by_corners)) return false;
  const Matrix12 scatter = linearised.scatter.selfadjointView<Eigen::Lower>();
  const Matrix12 by_noise = inverse.lazyProduct(scatter).eval().lazyProduct(inverse);
  const double systematic_px2 = params_.systematic_px * params_.systematic_px;
  const PoseInformation covariance =
      by_noise.topLeftCorner<6, 6>() / (curvature * curvature) + systematic_px2 * by_corners;
  PoseInformation inverted;
  if (!invert(covariance, inverted)) return false;
  information = 0.5 * (inverted + inverted.transpose());
  return information.allFinite() && (information.diagonal().array() > 0.0).all();
}

double CardRefinement::projected_px2(const Pose& camera_from_table) const {
  double doubled = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = corner_ray(camera_from_table, i);
    const Vec2 b = corner_ray(camera_from_table, (i + 1) % 4);
    doubled += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(doubled) * focal_px_ * focal_px_;
}

Vec3 CardRefinement::centre_mm() const {
  const CardModelSize& size = pattern_.size;
  return print_point_mm({0.5 * size.width_mm, 0.5 * size.height_mm}, size.thickness_mm);
}

Vec3 CardRefinement::corner_mm(std::size_t corner) const {
  return print_point_mm(print_corners_mm(pattern_.size)[corner], pattern_.size.thickness_mm);
}

double CardRefinement::corner_motion_px(const Pose& from, const Pose& to) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    largest = std::max(largest, (corner_ray(to, i) - corner_ray(from, i)).norm());
  }
  return largest * focal_px_;
}

CardLinearisation CardRefinement::linearise(const CardPatternLevel& level, CardSampling sampling,
                                            const CardFitState& state) const {
  return picture_.linearise(state.camera_from_table, pattern_.size, level, state.tone, cutoff_gray(state),
                            sampling);
}

// Of the pose by the four corners, each seen with an error of one pixel per axis.
PoseInformation CardRefinement::corner_information(const Pose& camera_from_table) const {
  PoseInformation information = PoseInformation::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 turned = camera_from_table.rotation * corner_mm(i);
    const Vec3 point = turned + camera_from_table.translation;
    for (int row = 0; row < 2; ++row) {
      const Vec3 by_point =
          (Vec3::Unit(row) - point[row] / point.z() * Vec3::UnitZ()) * (focal_px_ / point.z());
      Eigen::Matrix<double, 6, 1> by_step;
      by_step << turned.cross(by_point), by_point;
      information += by_step * by_step.transpose();
    }
  }
  return information;
}

}  // namespace traygauge
