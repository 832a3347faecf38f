#include "core/card/card_pattern.hpp"

#include <cmath>
#include <numbers>

namespace traygauge {
namespace {

constexpr double kSplineDeviation = std::numbers::inv_sqrt3;  // of the cubic B-spline with knots 1 apart
constexpr int kPrintColumns = 768;                            // source columns at a time: 3 KiB of sums
constexpr int kMaxTaps = kPrintColumns;   // of a kernel: a picture finer than 100 px/mm is blurred less
constexpr int kPool = 2 * kPrintColumns;  // weights of neighbouring kernels
constexpr int kMaxKernels = 64;           // target columns at a time, if the pool has weights for them
constexpr int kMinSide = 4;               // px of a level: the width of a cubic spline

double cubic_spline(double t) {
  const double a = std::abs(t);
  if (a >= 2.0) return 0.0;
  if (a >= 1.0) return (2.0 - a) * (2.0 - a) * (2.0 - a) / 6.0;
  return 2.0 / 3.0 - a * a * (1.0 - 0.5 * a);
}

// Along one axis: how many source and target pixels, and the distance of the spline's knots in source pixels.
struct Axis {
  int source = 0;
  int target = 0;
  double knot = 1.0;
};

// The source pixels that make up one target pixel.
struct Kernel {
  int first = 0;
  int count = 0;

  int end() const { return first + count; }
};

Kernel kernel_at(int target, const Axis& axis, double& centre) {
  centre = (target + 0.5) * axis.source / axis.target - 0.5;
  const int first = std::max(0, static_cast<int>(std::ceil(centre - 2.0 * axis.knot)));
  const int last = std::min(axis.source - 1, static_cast<int>(std::floor(centre + 2.0 * axis.knot)));
  return {first, std::clamp(last - first + 1, 1, kMaxTaps)};
}

// Their weights, which sum to 1; pixels beyond the edge have none.
void weigh(const Kernel& kernel, double centre, const Axis& axis, float* weights) {
  double sum = 0.0;
  for (int i = 0; i < kernel.count; ++i) {
    const double weight = cubic_spline((kernel.first + i - centre) / axis.knot);
    weights[i] = static_cast<float>(weight);
    sum += weight;
  }
  for (int i = 0; i < kernel.count; ++i) weights[i] = static_cast<float>(weights[i] / sum);
}

// Kernels of neighbouring target columns, as many as fit the pool and a block of source columns.
struct ColumnKernels {
  std::array<Kernel, kMaxKernels> kernels{};
  std::array<float, kPool> weights{};
  int count = 0;

  int first() const { return kernels[0].first; }
  int width() const { return kernels[static_cast<std::size_t>(count - 1)].end() - first(); }

  void set_up(int column, const Axis& axis) {
    std::ptrdiff_t used = 0;
    for (count = 0; count < kMaxKernels && column + count < axis.target; ++count) {
      double centre = 0.0;
      const Kernel kernel = kernel_at(column + count, axis, centre);
      if (count > 0 && (used + kernel.count > kPool || kernel.end() - first() > kPrintColumns)) break;
      weigh(kernel, centre, axis, weights.data() + used);
      kernels[static_cast<std::size_t>(count)] = kernel;
      used += kernel.count;
    }
  }
};

using Sums = std::array<float, kPrintColumns>;

// Light of the columns [first, first + width), summed over the kernel's rows.
void sum_columns(ImageView<const std::uint8_t> source, const Kernel& rows, const float* weights, int first,
                 int width, Sums& sums) {
  std::fill_n(sums.begin(), width, 0.0F);
  for (int i = 0; i < rows.count; ++i) {
    const std::uint8_t* row = source.row(rows.first + i) + first;
    const float weight = weights[i];
    for (int x = 0; x < width; ++x) {
      const auto gray = static_cast<float>(row[x]);
      sums[static_cast<std::size_t>(x)] += weight * (gray * gray);
    }
  }
}

void write_row(const ColumnKernels& columns, const Sums& sums, std::uint8_t* target) {
  const float* weights = columns.weights.data();
  for (int k = 0; k < columns.count; ++k) {
    const Kernel& kernel = columns.kernels[static_cast<std::size_t>(k)];
    const float* light_of = sums.data() + (kernel.first - columns.first());
    float light = 0.0F;
    for (int i = 0; i < kernel.count; ++i) light += weights[i] * light_of[i];
    weights += kernel.count;
    target[k] = static_cast<std::uint8_t>(std::min(255.0F, std::sqrt(light) + 0.5F));
  }
}

void blur_into(ImageView<const std::uint8_t> source, double knot_x, double knot_y,
               ImageView<std::uint8_t> target) {
  const Axis across{source.width, target.width, knot_x};
  const Axis down{source.height, target.height, knot_y};
  ColumnKernels columns;
  std::array<float, kMaxTaps> row_weights{};
  Sums sums;
  for (int x = 0; x < target.width; x += columns.count) {
    columns.set_up(x, across);
    for (int y = 0; y < target.height; ++y) {
      double centre = 0.0;
      const Kernel rows = kernel_at(y, down, centre);
      weigh(rows, centre, down, row_weights.data());
      sum_columns(source, rows, row_weights.data(), columns.first(), columns.width(), sums);
      write_row(columns, sums, target.row(y) + x);
    }
  }
}

}  // namespace

const CardPatternLevel& CardPattern::nearest_level(double blur_mm) const {
  std::size_t i = 0;
  while (i + 1 < levels.size() && blur_mm * blur_mm > levels[i].blur_mm * levels[i + 1].blur_mm) ++i;
  return levels[i];
}

Status prepare_card_pattern(ImageView<const std::uint8_t> picture, const CardModelSize& size,
                            const CardPatternParams& params, CardPattern& pattern) {
  const bool is_card = std::isfinite(size.area_mm2()) && size.width_mm > 0.0 && size.height_mm > 0.0;
  if (picture.empty() || !is_card) return StatusCode::invalid_configuration;
  pattern.size = size;
  const double fitting = std::sqrt(params.max_level_px / size.area_mm2());
  double px_per_mm = std::min(params.finest_px_per_mm, fitting);
  double blur_px = params.finest_blur_px;
  for (std::size_t i = 0; i < pattern.levels.size(); ++i) {
    CardPatternLevel& level = pattern.levels[i];
    const int width = static_cast<int>(size.width_mm * px_per_mm);
    const int height = static_cast<int>(size.height_mm * px_per_mm);
    const auto pixels =
        static_cast<std::size_t>(std::max(width, 0)) * static_cast<std::size_t>(std::max(height, 0));
    if (width < kMinSide || height < kMinSide) return StatusCode::invalid_configuration;
    if (pixels > pattern.storage[i].size()) return StatusCode::wrong_call;
    level.gray = {pattern.storage[i].data(), width, height};
    level.px_per_axis_mm = {width / size.width_mm, height / size.height_mm};
    level.blur_mm = blur_px / px_per_mm;
    const double knot_mm = level.blur_mm / kSplineDeviation;
    // A kernel narrower than the picture's own pixels would skip some.
    blur_into(picture, std::max(1.0, knot_mm * picture.width / size.width_mm),
              std::max(1.0, knot_mm * picture.height / size.height_mm), level.gray);
    if (i % 2 == 1) px_per_mm *= 0.5;
    blur_px = params.finest_blur_px * (i % 2 == 0 ? std::sqrt(2.0) : 1.0);
  }
  return {};
}

}  // namespace traygauge
