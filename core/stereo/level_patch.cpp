#include "core/stereo/level_patch.hpp"

#include <algorithm>
#include <cmath>

#include "core/image/gray_sampler.hpp"

namespace traygauge {

LevelPatch::LevelPatch(const SurfaceView& first, const SurfaceView& second, std::uint8_t label,
                       const Vec3& middle_mm, const LevelPatchParams& params)
    : params_(params), views_{&first, &second}, label_(label) {
  for (std::size_t i = 0; i < 2; ++i)
    levels_[i] = level_of(params.side_mm / kSide * px_per_mm(*views_[i], middle_mm), 1.0);
}

double LevelPatch::correlation(const Vec3& middle_mm) const {
  constexpr double kNone = -1.0;
  Samples first;
  Samples second;
  if (!read(0, middle_mm, first) || !read(1, middle_mm, second)) return kNone;
  const auto [least, most] = std::minmax(first.deviation, second.deviation);
  if (most > params_.max_contrast_ratio * least) return kNone;
  double product = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) product += static_cast<double>(first.gray[i]) * second.gray[i];
  return (product / kSamples - first.mean * second.mean) / (first.deviation * second.deviation);
}

bool LevelPatch::read(std::size_t view, const Vec3& middle_mm, Samples& samples) const {
  const SurfaceView& of_view = *views_[view];
  const auto is_bare = [&](const Vec2& pixel) { return of_view.label_at(pixel) == label_; };
  std::array<Vec2, 4> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 side(i % 2 == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0);
    Vec3 corner_mm = middle_mm;
    corner_mm.head<2>() += 0.5 * params_.side_mm * side;
    if (!of_view.find_pixel(corner_mm, corners[i]) || !is_bare(corners[i])) return false;
  }
  const GraySampler sampler(of_view.gray.levels[levels_[view]]);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const std::size_t column = i % kSide;
    const std::size_t row = i / kSide;
    const double u = (static_cast<double>(column) + 0.5) / kSide;
    const double v = (static_cast<double>(row) + 0.5) / kSide;
    const Vec2 pixel =
        (1.0 - v) * ((1.0 - u) * corners[0] + u * corners[1]) + v * ((1.0 - u) * corners[2] + u * corners[3]);
    float& gray = samples.gray[i];
    if (!is_bare(pixel) ||
        !sampler.sample({to_level(pixel.x(), levels_[view]), to_level(pixel.y(), levels_[view])}, gray))
      return false;
    sum += gray;
    squares += static_cast<double>(gray) * gray;
  }
  samples.mean = sum / kSamples;
  samples.deviation = std::sqrt(std::max(0.0, squares / kSamples - samples.mean * samples.mean));
  return samples.deviation >= params_.min_contrast;
}

}  // namespace traygauge
