#include "core/scale/card_pattern.hpp"

#include <cmath>

namespace traygauge {
namespace {

constexpr double kSplineDeviation = 0.57735026918962573;  // of the cubic B-spline with knots 1 apart: 1/√3
constexpr int kBlock = 1024;                              // source columns at a time: 4 KiB of sums
constexpr int kMaxTaps = kBlock - 2;  // of a kernel: a picture finer than 150 px/mm is blurred less
constexpr int kMinSide = 4;           // px of a level

double cubic_spline(double t) {
  const double a = std::abs(t);
  if (a >= 2.0) return 0.0;
  if (a >= 1.0) return (2.0 - a) * (2.0 - a) * (2.0 - a) / 6.0;
  return 2.0 / 3.0 - a * a * (1.0 - 0.5 * a);
}

// Weights of the source pixels that make up one target pixel along one axis; they sum to 1.
struct Kernel {
  int first = 0;
  int count = 0;
  std::array<float, kMaxTaps> weights;  // set by kernel_at

  int end() const { return first + count; }
};

// `knot`: distance of the spline's knots in source pixels. Pixels beyond the edge have no weight.
void kernel_at(int target, int target_size, int source_size, double knot, Kernel& kernel) {
  const double centre = (target + 0.5) * source_size / target_size - 0.5;
  kernel.first = std::max(0, static_cast<int>(std::ceil(centre - 2.0 * knot)));
  const int last = std::min(source_size - 1, static_cast<int>(std::floor(centre + 2.0 * knot)));
  kernel.count = std::clamp(last - kernel.first + 1, 1, kMaxTaps);
  double sum = 0.0;
  for (int i = 0; i < kernel.count; ++i) sum += cubic_spline((kernel.first + i - centre) / knot);
  for (int i = 0; i < kernel.count; ++i) {
    const double weight = cubic_spline((kernel.first + i - centre) / knot);
    kernel.weights[static_cast<std::size_t>(i)] = static_cast<float>(weight / sum);
  }
}

// Light of the columns [first, first + count), summed over the kernel's rows.
void sum_columns(ImageView<const std::uint8_t> source, const Kernel& rows, int first, int count,
                 std::array<float, kBlock>& sums) {
  sums.fill(0.0F);
  for (int i = 0; i < rows.count; ++i) {
    const std::uint8_t* row = source.row(rows.first + i) + first;
    const float weight = rows.weights[static_cast<std::size_t>(i)];
    for (int x = 0; x < count; ++x) {
      const auto gray = static_cast<float>(row[x]);
      sums[static_cast<std::size_t>(x)] += weight * (gray * gray);
    }
  }
}

std::uint8_t gray_of(const Kernel& columns, int first, const std::array<float, kBlock>& sums) {
  float light = 0.0F;
  for (int i = 0; i < columns.count; ++i) {
    light += columns.weights[static_cast<std::size_t>(i)] *
             sums[static_cast<std::size_t>(columns.first + i - first)];
  }
  return static_cast<std::uint8_t>(std::min(255.0F, std::sqrt(light) + 0.5F));
}

void blur_into(ImageView<const std::uint8_t> source, double knot_x, double knot_y,
               ImageView<std::uint8_t> target) {
  Kernel rows;
  Kernel columns;
  std::array<float, kBlock> sums;
  for (int y = 0; y < target.height; ++y) {
    kernel_at(y, target.height, source.height, knot_y, rows);
    int first = 0;
    int end = 0;
    for (int x = 0; x < target.width; ++x) {
      kernel_at(x, target.width, source.width, knot_x, columns);
      if (columns.end() > end) {
        first = columns.first;
        end = std::min(source.width, first + kBlock);
        sum_columns(source, rows, first, end - first, sums);
      }
      target.at(x, y) = gray_of(columns, first, sums);
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
    if (width < kMinSide || height < kMinSide || pixels > pattern.storage[i].size()) {
      return StatusCode::invalid_configuration;
    }
    level.gray = {pattern.storage[i].data(), width, height};
    level.px_per_mm = {width / size.width_mm, height / size.height_mm};
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
