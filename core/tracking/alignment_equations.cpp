#include "core/tracking/alignment_equations.hpp"

#include <array>
#include <cstddef>
#include <cstring>

#include "core/base/lanes.hpp"
#include "core/image/gaussian.hpp"
#include "core/tracking/patch_sampling.hpp"

namespace traygauge {
namespace {

constexpr int kGroups = kAlignmentSide / kFloatLanes;
static_assert(kGroups * kFloatLanes == kAlignmentSide);
constexpr double kWeightSigma = 0.3125 * kAlignmentSide;  // px: the middle of an edge still counts a quarter
constexpr auto kWeights = gaussian_row<kAlignmentSide>(kWeightSigma);

constexpr auto make_inverse_weights() {
  std::array<float, kAlignmentSide> inverse{};
  for (std::size_t i = 0; i < kAlignmentSide; ++i) inverse[i] = 1.0F / kWeights[i];
  return inverse;
}
constexpr auto kInverseWeights = make_inverse_weights();

float weight(int i) {
  return kWeights[static_cast<std::size_t>(i)];
}

double sum(FloatLanes lanes) {
  return static_cast<double>((lanes[0] + lanes[2]) + (lanes[1] + lanes[3]));
}

// Offsets of a group's columns from the patch's centre.
FloatLanes columns_of(int group) {
  const auto first = static_cast<float>(group * kFloatLanes - kAlignmentReach);
  return FloatLanes{first, first + 1.0F, first + 2.0F, first + 3.0F};
}

float row_offset(int j) {
  return static_cast<float>(j - kAlignmentReach);
}

// Sums over the patch of a quantity times 1, x, y, x², xy, y², from its sums down a group's columns.
struct Moments {
  double one = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  void add(FloatLanes by_one) { one += sum(by_one); }
  void add(FloatLanes columns, FloatLanes by_one, FloatLanes by_y) {
    one += sum(by_one);
    x += sum(columns * by_one);
    y += sum(by_y);
  }
  void add(FloatLanes columns, FloatLanes by_one, FloatLanes by_y, FloatLanes by_yy) {
    add(columns, by_one, by_y);
    xx += sum(columns * columns * by_one);
    xy += sum(columns * by_y);
    yy += sum(by_yy);
  }
};

void differentiate(const std::int16_t* sampled, AlignmentTemplate& patch) {
  constexpr std::ptrdiff_t kStride = kAlignmentSide + 2;
  constexpr float kValue = 1.0F / kPatchUnit;
  for (int j = 0; j < kAlignmentSide; ++j) {
    const std::int16_t* row = sampled + (j + 1) * kStride + 1;
    const float row_weight = 0.5F * kValue * weight(j);
    for (int i = 0; i < kAlignmentSide; ++i) {
      const float half_weight = row_weight * weight(i);
      const int at = j * kAlignmentSide + i;
      patch.values[at] = kValue * static_cast<float>(row[i]);
      patch.weighted_dx[at] = half_weight * static_cast<float>(row[i + 1] - row[i - 1]);
      patch.weighted_dy[at] = half_weight * static_cast<float>(row[i + kStride] - row[i - kStride]);
    }
  }
}

// What the normal matrix is made of: products of gradients, of gradients and values, and of values.
struct TemplateMoments {
  Moments dx_dx;
  Moments dx_dy;
  Moments dy_dy;
  Moments dx_v;
  Moments dy_v;
  Moments dx;
  Moments dy;
  double values = 0.0;
  double squares = 0.0;
  double weights = 0.0;
};

template <bool kAffine>
TemplateMoments take_moments(const AlignmentTemplate& patch) {
  TemplateMoments moments;
  for (int group = 0; group < kGroups; ++group) {
    constexpr std::size_t kProducts = 7;  // of the gradients: with each other, with the value, and alone
    std::array<FloatLanes, kProducts> by_one{};
    std::array<FloatLanes, kProducts> by_y{};
    std::array<FloatLanes, 3> by_yy{};
    FloatLanes value_sum{};
    FloatLanes square_sum{};
    FloatLanes weight_sum{};
    const FloatLanes column_weights = load_floats(kWeights.data() + std::ptrdiff_t{group} * kFloatLanes);
    const FloatLanes inverse_weights =
        load_floats(kInverseWeights.data() + std::ptrdiff_t{group} * kFloatLanes);
    for (int j = 0; j < kAlignmentSide; ++j) {
      const int at = j * kAlignmentSide + group * kFloatLanes;
      const FloatLanes v = load_floats(patch.values + at);
      const FloatLanes wdx = load_floats(patch.weighted_dx + at);
      const FloatLanes wdy = load_floats(patch.weighted_dy + at);
      const FloatLanes w = weight(j) * column_weights;
      const FloatLanes inverse = kInverseWeights[static_cast<std::size_t>(j)] * inverse_weights;
      const FloatLanes dy = wdy * inverse;
      const std::array<FloatLanes, kProducts> products = {
          wdx * (wdx * inverse), wdx * dy, wdy * dy, wdx * v, wdy * v, wdx, wdy};
      for (std::size_t k = 0; k < kProducts; ++k) by_one[k] += products[k];
      if constexpr (kAffine) {
        const float y = row_offset(j);
        for (std::size_t k = 0; k < kProducts; ++k) by_y[k] += y * products[k];
        for (std::size_t k = 0; k < by_yy.size(); ++k) by_yy[k] += y * y * products[k];
      }
      value_sum += w * v;
      square_sum += w * v * v;
      weight_sum += w;
    }
    const FloatLanes columns = columns_of(group);
    const std::array<Moments*, kProducts> targets = {&moments.dx_dx, &moments.dx_dy, &moments.dy_dy,
                                                     &moments.dx_v,  &moments.dy_v,  &moments.dx,
                                                     &moments.dy};
    for (std::size_t k = 0; k < kProducts; ++k) {
      if constexpr (!kAffine) {
        targets[k]->add(by_one[k]);
      } else if (k < by_yy.size()) {
        targets[k]->add(columns, by_one[k], by_y[k], by_yy[k]);
      } else {
        targets[k]->add(columns, by_one[k], by_y[k]);
      }
    }
    moments.values += sum(value_sum);
    moments.squares += sum(square_sum);
    moments.weights += sum(weight_sum);
  }
  return moments;
}

struct ShiftColumns {
  int shift;
  int by_x;
  int by_y;
};

// Columns of a shift and its matrix row against those of another: gradients' products times 1, x, y, …
void fill_block(const ShiftColumns& a, const ShiftColumns& b, const Moments& m,
                AlignmentEquations::Matrix& hessian) {
  hessian(b.shift, a.shift) = m.one;
  hessian(b.by_x, a.shift) = hessian(a.by_x, b.shift) = m.x;
  hessian(b.by_y, a.shift) = hessian(a.by_y, b.shift) = m.y;
  hessian(b.by_x, a.by_x) = m.xx;
  hessian(b.by_y, a.by_y) = m.yy;
  hessian(b.by_y, a.by_x) = hessian(b.by_x, a.by_y) = m.xy;
}

void fill_row(int row, const Moments& x, const Moments& y, AlignmentEquations::Matrix& hessian) {
  hessian(row, kShiftX) = x.one;
  hessian(row, kXByX) = x.x;
  hessian(row, kXByY) = x.y;
  hessian(row, kShiftY) = y.one;
  hessian(row, kYByX) = y.x;
  hessian(row, kYByY) = y.y;
}

void fill_normal_matrix(const TemplateMoments& moments, AlignmentTemplate& patch) {
  constexpr ShiftColumns kX{kShiftX, kXByX, kXByY};
  constexpr ShiftColumns kY{kShiftY, kYByX, kYByY};
  AlignmentEquations::Matrix& hessian = patch.equations.hessian;
  fill_block(kX, kX, moments.dx_dx, hessian);
  fill_block(kX, kY, moments.dx_dy, hessian);
  fill_block(kY, kY, moments.dy_dy, hessian);
  fill_row(kGain, moments.dx_v, moments.dy_v, hessian);
  fill_row(kOffset, moments.dx, moments.dy, hessian);
  hessian(kGain, kGain) = moments.squares;
  hessian(kOffset, kGain) = moments.values;
  hessian(kOffset, kOffset) = moments.weights;
  patch.weighted_squares = moments.squares;
}

template <bool kAffine>
AlignmentResiduals gather(const float* window, AlignmentTemplate& patch) {
  Moments by_dx;
  Moments by_dy;
  double by_value = 0.0;
  double by_one = 0.0;
  AlignmentResiduals residuals;
  for (int group = 0; group < kGroups; ++group) {
    FloatLanes dx_sum{};
    FloatLanes dy_sum{};
    FloatLanes dx_by_y{};
    FloatLanes dy_by_y{};
    FloatLanes value_sum{};
    FloatLanes sum_of_r{};
    FloatLanes square_sum{};
    const FloatLanes column_weights = load_floats(kWeights.data() + std::ptrdiff_t{group} * kFloatLanes);
    for (int j = 0; j < kAlignmentSide; ++j) {
      const int at = j * kAlignmentSide + group * kFloatLanes;
      const FloatLanes v = load_floats(patch.values + at);
      const FloatLanes r = load_floats(window + at) - v;
      const FloatLanes dx_r = load_floats(patch.weighted_dx + at) * r;
      const FloatLanes dy_r = load_floats(patch.weighted_dy + at) * r;
      const FloatLanes w_r = weight(j) * column_weights * r;
      dx_sum += dx_r;
      dy_sum += dy_r;
      if constexpr (kAffine) {
        dx_by_y += row_offset(j) * dx_r;
        dy_by_y += row_offset(j) * dy_r;
      }
      value_sum += w_r * v;
      sum_of_r += w_r;
      square_sum += w_r * r;
    }
    by_dx.add(columns_of(group), dx_sum, dx_by_y);
    by_dy.add(columns_of(group), dy_sum, dy_by_y);
    by_value += sum(value_sum);
    by_one += sum(sum_of_r);
    residuals.squares += sum(square_sum);
  }
  // solve() yields −H⁻¹ g; what fits r is H⁻¹ Jᵀ W r.
  patch.equations.gradient << -by_dx.one, -by_dy.one, -by_dx.x, -by_dx.y, -by_dy.x, -by_dy.y, -by_value,
      -by_one;
  residuals.seen = by_one + patch.equations.hessian(kOffset, kGain);
  residuals.seen_squares = residuals.squares + 2.0 * by_value + patch.weighted_squares;
  return residuals;
}

}  // namespace

ShiftEquations without_matrix(const AlignmentEquations& equations) {
  constexpr std::array<int, 4> kKept = {kShiftX, kShiftY, kGain, kOffset};
  ShiftEquations kept;
  for (int i = 0; i < 4; ++i) {
    const int row = kKept[static_cast<std::size_t>(i)];
    kept.gradient[i] = equations.gradient[row];
    for (int j = 0; j <= i; ++j)
      kept.hessian(i, j) = equations.hessian(row, kKept[static_cast<std::size_t>(j)]);
  }
  return kept;
}

bool make_template(ImageView<const std::uint8_t> first, const Vec2& pixel, const Eigen::Matrix2d& map,
                   PatchMotion motion, AlignmentTemplate& patch) {
  // A ring more than the patch, for the gradients.
  constexpr int kSampledSide = kAlignmentSide + 2;
  std::array<std::int16_t, std::size_t{kSampledSide} * kSampledSide> sampled;
  if (!sample_patch<kSampledSide>(first, pixel, map, sampled.data())) return false;
  differentiate(sampled.data(), patch);
  fill_normal_matrix(motion == PatchMotion::affine ? take_moments<true>(patch) : take_moments<false>(patch),
                     patch);
  return true;
}

AlignmentResiduals gather_residuals(const float* window, PatchMotion motion, AlignmentTemplate& patch) {
  return motion == PatchMotion::affine ? gather<true>(window, patch) : gather<false>(window, patch);
}

}  // namespace traygauge
