#include "core/matching/patch_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/base/levenberg_marquardt.hpp"
#include "core/features/gaussian.hpp"
#include "core/matching/patch_sampling.hpp"

namespace traygauge {
namespace {

// Compiler vectors: the order of all sums is written down, so every processor gets the same bits.
using Lanes [[gnu::vector_size(16)]] = float;
constexpr int kLanes = 4;
constexpr int kGroups = kAlignmentSide / kLanes;
constexpr double kReach = 0.5 * (kAlignmentSide - 1);
constexpr double kWeightSigma = 7.5;  // px of the window: the patch's edge still counts a third
constexpr auto kWeights = gaussian_row<kAlignmentSide>(kWeightSigma);

// Columns of the least-squares problem: shift, its affine terms, gain, offset.
enum Column : std::uint8_t { kShiftX, kShiftY, kXByX, kXByY, kYByX, kYByY, kGain, kOffset, kColumns };
using Equations = NormalEquations<kColumns>;

Lanes load(const float* source) {
  Lanes lanes;
  std::memcpy(&lanes, source, sizeof lanes);
  return lanes;
}

void store(float* target, Lanes lanes) {
  std::memcpy(target, &lanes, sizeof lanes);
}

double sum(Lanes lanes) {
  return static_cast<double>((lanes[0] + lanes[2]) + (lanes[1] + lanes[3]));
}

// Offsets of a group's columns from the patch's centre.
Lanes columns_of(int group) {
  const auto first = static_cast<float>(group * kLanes - kReach);
  return Lanes{first, first + 1.0F, first + 2.0F, first + 3.0F};
}

// Sums over the patch of a quantity times 1, x, y, x², xy, y², from its sums per column.
struct Moments {
  double one = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  void add(Lanes columns, Lanes by_one, Lanes by_y, Lanes by_yy) {
    one += sum(by_one);
    x += sum(columns * by_one);
    y += sum(by_y);
    xx += sum(columns * columns * by_one);
    xy += sum(columns * by_y);
    yy += sum(by_yy);
  }
};

// The first view's patch on the grid of the second, its gradients times the window's weights, and the normal
// matrix, which stays while the patch only shifts.
struct AlignmentTemplate {
  alignas(16) float values[kAlignmentSide * kAlignmentSide];
  alignas(16) float weighted_dx[kAlignmentSide * kAlignmentSide];
  alignas(16) float weighted_dy[kAlignmentSide * kAlignmentSide];
  Equations equations;
  double weighted_squares = 0.0;  // Σ w v²
};

constexpr double kCorrelatedNoise =
    1.4;  // standard deviations grow by it: noise of compressed pictures is not white
constexpr double kGradientNoise = 0.5;  // variance of a central difference per variance of white noise

void differentiate(const std::int16_t* sampled, AlignmentTemplate& patch) {
  constexpr int kStride = kAlignmentSide + 2;
  constexpr float kValue = 1.0F / kPatchUnit;
  for (int j = 0; j < kAlignmentSide; ++j) {
    const std::int16_t* row = sampled + (j + 1) * kStride + 1;
    const float row_weight = kWeights[static_cast<std::size_t>(j)];
    for (int i = 0; i < kAlignmentSide; ++i) {
      const float half_weight = 0.5F * kValue * row_weight * kWeights[static_cast<std::size_t>(i)];
      const int at = j * kAlignmentSide + i;
      patch.values[at] = kValue * static_cast<float>(row[i]);
      patch.weighted_dx[at] = half_weight * static_cast<float>(row[i + 1] - row[i - 1]);
      patch.weighted_dy[at] = half_weight * static_cast<float>(row[i + kStride] - row[i - kStride]);
    }
  }
}

void fill_normal_matrix(AlignmentTemplate& patch) {
  Moments dx_dx;
  Moments dx_dy;
  Moments dy_dy;
  Moments dx_v;
  Moments dy_v;
  Moments dx_1;
  Moments dy_1;
  double values = 0.0;
  double squares = 0.0;
  double weights = 0.0;
  for (int group = 0; group < kGroups; ++group) {
    std::array<std::array<Lanes, 3>, 7> sums{};  // by 1, y, y²
    Lanes value_sum{};
    Lanes square_sum{};
    Lanes weight_sum{};
    for (int j = 0; j < kAlignmentSide; ++j) {
      const int at = j * kAlignmentSide + group * kLanes;
      const Lanes v = load(patch.values + at);
      const Lanes wdx = load(patch.weighted_dx + at);
      const Lanes wdy = load(patch.weighted_dy + at);
      const Lanes w = kWeights[static_cast<std::size_t>(j)] * load(kWeights.data() + group * kLanes);
      const auto y = static_cast<float>(j - kReach);
      const Lanes dx = wdx / w;
      const Lanes dy = wdy / w;
      const std::array<Lanes, 7> products = {wdx * dx, wdx * dy, wdy * dy, wdx * v, wdy * v, wdx, wdy};
      for (std::size_t k = 0; k < products.size(); ++k) {
        sums[k][0] += products[k];
        sums[k][1] += y * products[k];
        if (k < 3) sums[k][2] += y * y * products[k];
      }
      value_sum += w * v;
      square_sum += w * v * v;
      weight_sum += w;
    }
    const Lanes columns = columns_of(group);
    const std::array<Moments*, 7> moments = {&dx_dx, &dx_dy, &dy_dy, &dx_v, &dy_v, &dx_1, &dy_1};
    for (std::size_t k = 0; k < moments.size(); ++k)
      moments[k]->add(columns, sums[k][0], sums[k][1], sums[k][2]);
    values += sum(value_sum);
    squares += sum(square_sum);
    weights += sum(weight_sum);
  }
  auto& h = patch.equations.hessian;
  const auto block = [&h](Column shift, Column by_x, Column by_y, Column other, Column other_by_x,
                          Column other_by_y, const Moments& m) {
    h(other, shift) = m.one;
    h(other_by_x, shift) = h(by_x, other) = m.x;
    h(other_by_y, shift) = h(by_y, other) = m.y;
    h(other_by_x, by_x) = m.xx;
    h(other_by_y, by_y) = m.yy;
    h(other_by_y, by_x) = h(other_by_x, by_y) = m.xy;
  };
  block(kShiftX, kXByX, kXByY, kShiftX, kXByX, kXByY, dx_dx);
  block(kShiftX, kXByX, kXByY, kShiftY, kYByX, kYByY, dx_dy);
  block(kShiftY, kYByX, kYByY, kShiftY, kYByX, kYByY, dy_dy);
  const auto row = [&h](Column with, const Moments& x, const Moments& y) {
    h(with, kShiftX) = x.one;
    h(with, kXByX) = x.x;
    h(with, kXByY) = x.y;
    h(with, kShiftY) = y.one;
    h(with, kYByX) = y.x;
    h(with, kYByY) = y.y;
  };
  row(kGain, dx_v, dy_v);
  row(kOffset, dx_1, dy_1);
  h(kGain, kGain) = squares;
  h(kOffset, kGain) = values;
  h(kOffset, kOffset) = weights;
  patch.weighted_squares = squares;
}

bool make_template(ImageView<const std::uint8_t> first, const Vec2& pixel, const Eigen::Matrix2d& map,
                   AlignmentTemplate& patch) {
  std::array<std::int16_t, (kAlignmentSide + 2) * (kAlignmentSide + 2)> sampled;
  if (!sample_patch<kAlignmentSide + 2>(first, pixel, map, sampled.data())) return false;
  differentiate(sampled.data(), patch);
  fill_normal_matrix(patch);
  return true;
}

// The second picture's patch at a fraction of a pixel; whole pixels are converted once.
class Window {
 public:
  explicit Window(ImageView<const std::uint8_t> gray) : gray_(gray) {}

  bool sample(const Vec2& centre, float* values) {
    const double x = centre.x() - kReach;
    const double y = centre.y() - kReach;
    if (!(x >= 1.0 && y >= 1.0 && x < gray_.width - kStride - 1 && y < gray_.height - kSide - 1))
      return false;
    const int left = static_cast<int>(x);
    const int top = static_cast<int>(y);
    if (left != left_ || top != top_) load_pixels(left, top);
    const auto fx = static_cast<float>(x - left);
    const auto fy = static_cast<float>(y - top);
    const float upper_left = (1.0F - fx) * (1.0F - fy);
    const float upper_right = fx * (1.0F - fy);
    const float lower_left = (1.0F - fx) * fy;
    const float lower_right = fx * fy;
    for (int j = 0; j < kAlignmentSide; ++j) {
      for (int i = 0; i < kAlignmentSide; i += kLanes, values += kLanes) {
        const float* upper = pixels_ + j * kStride + i;
        const float* lower = upper + kStride;
        store(values, (upper_left * load(upper) + upper_right * load(upper + 1)) +
                          (lower_left * load(lower) + lower_right * load(lower + 1)));
      }
    }
    return true;
  }

 private:
  static constexpr int kSide = kAlignmentSide + 1;
  static constexpr int kStride = kAlignmentSide + kLanes;

  void load_pixels(int left, int top) {
    left_ = left;
    top_ = top;
    for (int j = 0; j < kSide; ++j) {
      const std::uint8_t* row = gray_.row(top + j) + left;
      for (int i = 0; i < kStride; ++i) pixels_[j * kStride + i] = static_cast<float>(row[i]);
    }
  }

  ImageView<const std::uint8_t> gray_;
  int left_ = -1;
  int top_ = -1;
  alignas(16) float pixels_[kSide * kStride];
};

struct Residuals {
  double squares = 0.0;       // Σ w r²
  double seen = 0.0;          // Σ w s, s the second view's values
  double seen_squares = 0.0;  // Σ w s²
};

// r = second − first: its products with all columns go into the gradient.
Residuals gather_residuals(const AlignmentTemplate& patch, const float* window, Equations& equations) {
  Moments by_dx;
  Moments by_dy;
  double by_value = 0.0;
  double by_one = 0.0;
  Residuals residuals;
  for (int group = 0; group < kGroups; ++group) {
    std::array<Lanes, 9> sums{};
    for (int j = 0; j < kAlignmentSide; ++j) {
      const int at = j * kAlignmentSide + group * kLanes;
      const Lanes v = load(patch.values + at);
      const Lanes r = load(window + at) - v;
      const Lanes w = kWeights[static_cast<std::size_t>(j)] * load(kWeights.data() + group * kLanes);
      const auto y = static_cast<float>(j - kReach);
      const Lanes dx_r = load(patch.weighted_dx + at) * r;
      const Lanes dy_r = load(patch.weighted_dy + at) * r;
      const Lanes w_r = w * r;
      sums[0] += dx_r;
      sums[1] += y * dx_r;
      sums[2] += dy_r;
      sums[3] += y * dy_r;
      sums[4] += w_r * v;
      sums[5] += w_r;
      sums[6] += w_r * r;
    }
    const Lanes columns = columns_of(group);
    by_dx.add(columns, sums[0], sums[1], Lanes{});
    by_dy.add(columns, sums[2], sums[3], Lanes{});
    by_value += sum(sums[4]);
    by_one += sum(sums[5]);
    residuals.squares += sum(sums[6]);
  }
  // solve() yields −H⁻¹ g; the fit of the columns to r is H⁻¹ Jᵀ W r.
  equations.gradient << -by_dx.one, -by_dy.one, -by_dx.x, -by_dx.y, -by_dy.x, -by_dy.y, -by_value, -by_one;
  residuals.seen = by_one + patch.equations.hessian(kOffset, kGain);
  residuals.seen_squares = residuals.squares + 2.0 * by_value + patch.weighted_squares;
  return residuals;
}

// The same equations for shift, gain and offset alone.
NormalEquations<4> without_affine(const Equations& all) {
  constexpr std::array<int, 4> kKept = {kShiftX, kShiftY, kGain, kOffset};
  NormalEquations<4> some;
  for (int i = 0; i < 4; ++i) {
    some.gradient[i] = all.gradient[kKept[static_cast<std::size_t>(i)]];
    for (int j = 0; j <= i; ++j)
      some.hessian(i, j) =
          all.hessian(kKept[static_cast<std::size_t>(i)], kKept[static_cast<std::size_t>(j)]);
  }
  return some;
}

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
// lies in its gradients too: the equations hold H = S + N, of which the noise's part N tells nothing about
// the place, so that the covariance is noise · S⁻¹ H S⁻¹.
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
  structure.diagonal().array() -= weights * kGradientNoise * 0.5 * noise;
  if (!(structure.determinant() > 0.0 && structure.trace() > 0.0)) return false;
  const Mat2 signal = inverse_of(structure);
  const Mat2 covariance = noise * signal * shifts * signal;
  variance = 0.5 * covariance.trace();
  return variance > 0.0;
}

class Aligner {
 public:
  Aligner(ImageView<const std::uint8_t> first, const Vec2& first_pixel, ImageView<const std::uint8_t> second,
          const PatchAlignmentParams& params, PatchAlignment& alignment)
      : first_(first),
        first_pixel_(first_pixel),
        window_(second),
        params_(params),
        alignment_(alignment),
        start_(alignment.pixel),
        start_map_(alignment.first_from_second) {}

  bool run(PatchMotion motion) {
    if (!make_template(first_, first_pixel_, alignment_.first_from_second, patch_)) return false;
    if (!shift(params_.max_shifts)) return false;
    if (motion == PatchMotion::affine) {
      for (int i = 0; i < params_.max_affine_steps; ++i) {
        bool converged = false;
        if (!refine_affine(converged)) return false;
        if (!make_template(first_, first_pixel_, alignment_.first_from_second, patch_)) return false;
        if (converged) break;
      }
      if (!shift(2)) return false;
    }
    return judge(motion);
  }

 private:
  bool shift(int max_steps) {
    for (int i = 0; i < max_steps; ++i) {
      if (!gather()) return false;
      NormalEquations<4>::Vector step = NormalEquations<4>::Vector::Zero();
      if (!without_affine(patch_.equations).solve(0.0, step)) return false;
      alignment_.pixel -= step.head<2>();
      if (!is_near()) return false;
      if (step.head<2>().squaredNorm() < params_.converged_px * params_.converged_px) return true;
    }
    return true;
  }

  bool refine_affine(bool& converged) {
    if (!gather()) return false;
    Equations equations = patch_.equations;
    const double prior =
        params_.grey_sigma * params_.grey_sigma / (params_.affine_sigma * params_.affine_sigma);
    for (int i = kXByX; i <= kYByY; ++i) equations.hessian(i, i) += prior;
    Equations::Vector step = Equations::Vector::Zero();
    if (!equations.solve(0.0, step)) return false;
    // second(u) = first(u + d + D u): the first view's grid moves by the inverse of the step.
    Eigen::Matrix2d change = Eigen::Matrix2d::Identity();
    change(0, 0) += step[kXByX];
    change(0, 1) += step[kXByY];
    change(1, 0) += step[kYByX];
    change(1, 1) += step[kYByY];
    const double determinant = change.determinant();
    if (!(determinant > 0.25)) return false;
    const Vec2 d(step[kShiftX], step[kShiftY]);
    alignment_.pixel -= Vec2((change(1, 1) * d.x() - change(0, 1) * d.y()) / determinant,
                             (change(0, 0) * d.y() - change(1, 0) * d.x()) / determinant);
    alignment_.first_from_second = alignment_.first_from_second * change;
    const double bend_px = kReach * (change - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff();
    converged = bend_px < 0.1 && d.squaredNorm() < 0.01;
    return is_near();
  }

  bool judge(PatchMotion motion) {
    if (!gather()) return false;
    const Equations& equations = patch_.equations;
    if (motion == PatchMotion::affine) return judge_with(equations, kGain);
    return judge_with(without_affine(equations), 2);
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
    residuals_ = gather_residuals(patch_, seen_, patch_.equations);
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
  Window window_;
  const PatchAlignmentParams& params_;
  PatchAlignment& alignment_;
  Vec2 start_;
  Eigen::Matrix2d start_map_;
  AlignmentTemplate patch_;
  Residuals residuals_;
  alignas(16) float seen_[kAlignmentSide * kAlignmentSide];
};

}  // namespace

bool align_patch(ImageView<const std::uint8_t> first, const Vec2& first_pixel,
                 ImageView<const std::uint8_t> second, PatchMotion motion, const PatchAlignmentParams& params,
                 PatchAlignment& alignment) {
  return Aligner(first, first_pixel, second, params, alignment).run(motion);
}

}  // namespace traygauge
