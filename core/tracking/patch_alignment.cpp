#include "core/tracking/patch_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/tracking/alignment_window.hpp"

namespace traygauge {
namespace {

// Standard deviations grow by it: the noise of compressed pictures is not white. Measured on rendered scenes
// of all kinds, where it lies between 1.2 and 1.5.
constexpr double kCorrelatedNoise = 1.4;

using Mat2 = Eigen::Matrix2d;

Mat2 inverse_of(const Mat2& m) {
  Mat2 adjugate;
  adjugate << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return adjugate / m.determinant();
}

// How much of Σ w r² a step takes away.
template <int kParameters>
double explained_squares(const NormalEquations<kParameters>& equations,
                         const typename NormalEquations<kParameters>::Vector& step) {
  double total = 0.0;
  for (int i = 0; i < kParameters; ++i) total -= step[i] * equations.gradient[i];
  return total;
}

// Mean variance of the two shifts for residuals of variance `noise`, half of which is the patch's own and so
// lies in its gradients too: a central difference has half their variance; the equations hold H = S + N, of
// which the noise's part N tells nothing about the place, so that the covariance is noise · S⁻¹ H S⁻¹.
template <int kParameters>
bool shift_variance(NormalEquations<kParameters> equations, double noise, double weights, double& variance) {
  Mat2 inverse;
  for (int i = 0; i < 2; ++i) {
    typename NormalEquations<kParameters>::Vector column;
    equations.gradient.setZero();
    equations.gradient[i] = -1.0;
    if (!equations.solve(0.0, column)) return false;
    inverse(0, i) = column[0];
    inverse(1, i) = column[1];
  }
  const Mat2 shifts = inverse_of(inverse);
  Mat2 structure = shifts;
  structure.diagonal().array() -= 0.25 * weights * noise;
  if (!(structure.determinant() > 0.0 && structure.trace() > 0.0)) return false;
  const Mat2 signal = inverse_of(structure);
  const Mat2 covariance = noise * signal * shifts * signal;
  variance = 0.5 * covariance.trace();
  return variance > 0.0;
}

class Aligner {
 public:
  Aligner(ImageView<const std::uint8_t> first, Vec2 first_pixel, ImageView<const std::uint8_t> second,
          PatchMotion motion, const PatchAlignmentParams& params, PatchAlignment& alignment)
      : first_(first),
        first_pixel_(std::move(first_pixel)),
        window_(second),
        motion_(motion),
        params_(params),
        alignment_(alignment),
        start_(alignment.pixel),
        start_map_(alignment.first_from_second) {}

  bool run() {
    if (!make_template()) return false;
    if (!shift(params_.max_shifts)) return false;
    if (motion_ == PatchMotion::affine) {
      for (int i = 0; i < params_.max_affine_steps; ++i) {
        bool converged = false;
        if (!refine_affine(converged)) return false;
        if (!make_template()) return false;
        if (converged) break;
      }
      if (!shift(2)) return false;
    }
    return judge();
  }

 private:
  bool make_template() {
    return traygauge::make_template(first_, first_pixel_, alignment_.first_from_second, motion_, patch_);
  }

  bool shift(int max_steps) {
    for (int i = 0; i < max_steps; ++i) {
      if (!gather()) return false;
      ShiftEquations::Vector step = ShiftEquations::Vector::Zero();
      if (!without_matrix(patch_.equations).solve(0.0, step)) return false;
      alignment_.pixel -= step.head<2>();
      if (!is_near()) return false;
      if (step.head<2>().squaredNorm() < params_.converged_px * params_.converged_px) return true;
    }
    return true;
  }

  bool refine_affine(bool& converged) {
    if (!gather()) return false;
    AlignmentEquations equations = patch_.equations;
    const double prior =
        params_.grey_sigma * params_.grey_sigma / (params_.affine_sigma * params_.affine_sigma);
    for (int i = kXByX; i <= kYByY; ++i) equations.hessian(i, i) += prior;
    AlignmentEquations::Vector step = AlignmentEquations::Vector::Zero();
    if (!equations.solve(0.0, step)) return false;
    // second(u) = first(u + d + D u): the first view's grid moves by the inverse of the step.
    Eigen::Matrix2d change = Eigen::Matrix2d::Identity();
    change(0, 0) += step[kXByX];
    change(0, 1) += step[kXByY];
    change(1, 0) += step[kYByX];
    change(1, 1) += step[kYByY];
    const double determinant = change.determinant();
    if (!(determinant > 0.0)) return false;
    const Vec2 d(step[kShiftX], step[kShiftY]);
    alignment_.pixel -= Vec2((change(1, 1) * d.x() - change(0, 1) * d.y()) / determinant,
                             (change(0, 0) * d.y() - change(1, 0) * d.x()) / determinant);
    alignment_.first_from_second = alignment_.first_from_second * change;
    const double bend_px = kAlignmentReach * (change - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff();
    converged = bend_px < 0.1 && d.squaredNorm() < 0.01;
    return is_near();
  }

  bool judge() {
    if (!gather()) return false;
    const AlignmentEquations& equations = patch_.equations;
    if (motion_ == PatchMotion::affine) return judge_with(equations, kGain);
    return judge_with(without_matrix(equations), kGainOfShift);
  }

  template <int kParameters>
  bool judge_with(const NormalEquations<kParameters>& equations, int gain_column) {
    typename NormalEquations<kParameters>::Vector step = NormalEquations<kParameters>::Vector::Zero();
    if (!equations.solve(0.0, step)) return false;
    const double weights = patch_.equations.hessian(kOffset, kOffset);
    const double rest = std::max(0.0, residuals_.squares - explained_squares(equations, step)) / weights;
    const double contrast = (residuals_.seen_squares - residuals_.seen * residuals_.seen / weights) / weights;
    if (!(contrast > 0.0 && 1.0 + step[gain_column] > 0.0)) return false;
    alignment_.correlation = std::sqrt(std::max(0.0, 1.0 - rest / contrast));
    alignment_.residual_grey = std::sqrt(rest);
    const double noise = std::max(rest, params_.grey_sigma * params_.grey_sigma);
    double variance = 0.0;
    if (!shift_variance(equations, noise, weights, variance)) return false;
    alignment_.sigma_px = kCorrelatedNoise * std::sqrt(variance);
    return std::isfinite(alignment_.sigma_px);
  }

  bool gather() {
    if (!window_.sample(alignment_.pixel, seen_)) return false;
    residuals_ = gather_residuals(seen_, motion_, patch_);
    return true;
  }

  bool is_near() const {
    const Vec2 moved = alignment_.pixel - start_;
    const Eigen::Matrix2d bent = alignment_.first_from_second - start_map_;
    return moved.squaredNorm() <= params_.max_shift_px * params_.max_shift_px &&
           bent.cwiseAbs().maxCoeff() <= params_.max_affine_change;
  }

  ImageView<const std::uint8_t> first_;
  Vec2 first_pixel_;
  AlignmentWindow window_;
  PatchMotion motion_;
  const PatchAlignmentParams& params_;
  PatchAlignment& alignment_;
  Vec2 start_;
  Eigen::Matrix2d start_map_;
  AlignmentTemplate patch_;
  AlignmentResiduals residuals_;
  alignas(16) float seen_[kAlignmentPixels];
};

}  // namespace

bool align_patch(ImageView<const std::uint8_t> first, const Vec2& first_pixel,
                 ImageView<const std::uint8_t> second, PatchMotion motion, const PatchAlignmentParams& params,
                 PatchAlignment& alignment) {
  return Aligner(first, first_pixel, second, motion, params, alignment).run();
}

}  // namespace traygauge
