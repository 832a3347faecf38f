#include "core/tracking/patch_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/tracking/patch_sampling.hpp"

namespace traygauge {
namespace {

constexpr int kPixels = kSearchSide * kSearchSide;
constexpr double kHalf = 0.5 * (kSearchSide - 1);  // from the patch's first pixel to its centre
constexpr float kMinVariation =
    kPixels;                    // Σ(v − mean)² of a patch: a grey value a pixel, the least to correlate
constexpr double kApart = 2.0;  // pixels within which two bands see the same peak

constexpr float kNotScored = std::numeric_limits<float>::lowest();

struct alignas(16) SearchTemplate {
  std::int16_t values[kPixels];
  std::int32_t sum = 0;
  float inverse_norm = 0.0F;
};

bool make_template(ImageView<const std::uint8_t> first, const Vec2& centre, const Eigen::Matrix2d& map,
                   SearchTemplate& patch) {
  if (!sample_patch<kSearchSide>(first, centre, map, patch.values)) return false;
  std::int32_t sum = 0;
  std::int32_t squares = 0;
  for (const std::int16_t value : patch.values) {
    sum += value;
    squares += value * value;
  }
  const std::int64_t variation = std::int64_t{kPixels} * squares - std::int64_t{sum} * sum;
  const float norm = static_cast<float>(variation) / kPixels;
  if (!(norm > kMinVariation * kPatchUnit * kPatchUnit)) return false;
  patch.sum = sum;
  patch.inverse_norm = 1.0F / std::sqrt(norm);
  return true;
}

float correlate(const SearchTemplate& patch, const std::int16_t* window, std::ptrdiff_t stride) {
  // In one piece, so that three long sums remain instead of many short ones.
  alignas(16) std::int16_t values[kPixels];
  for (int j = 0; j < kSearchSide; ++j)
    std::memcpy(values + std::ptrdiff_t{j} * kSearchSide, window + j * stride,
                kSearchSide * sizeof values[0]);
  std::int32_t products = 0;
  std::int32_t squares = 0;
  std::int32_t sum = 0;
  for (int i = 0; i < kPixels; ++i) {
    products += patch.values[i] * values[i];
    squares += values[i] * values[i];
    sum += values[i];
  }
  const std::int32_t variation = kPixels * squares - sum * sum;
  const float norm = static_cast<float>(variation) / kPixels;
  if (!(norm > kMinVariation)) return -1.0F;
  const std::int64_t covariation = std::int64_t{kPixels} * products - std::int64_t{patch.sum} * sum;
  return static_cast<float>(covariation) / kPixels * patch.inverse_norm / std::sqrt(norm);
}

// Narrows [lo, hi] to where low ≤ slope · x + offset ≤ high.
void clip(double slope, double offset, double low, double high, double& lo, double& hi) {
  if (std::abs(slope) < 1e-9) {
    if (offset < low || offset > high) hi = lo - 1.0;
    return;
  }
  const double a = (low - offset) / slope;
  const double b = (high - offset) / slope;
  lo = std::max(lo, std::min(a, b));
  hi = std::min(hi, std::max(a, b));
}

}  // namespace

bool PatchSearch::search(const Vec2& centre, const SearchBand& band) {
  SearchTemplate patch;
  if (!make_template(first_, centre, band.first_from_second, patch)) return false;
  const double length = (band.end - band.begin).norm();
  const Vec2 along = length > 1e-6 ? Vec2((band.end - band.begin) / length) : Vec2::UnitX();
  const Vec2 across(-along.y(), along.x());
  // In coordinates of the patch's first pixel.
  const Vec2 begin = band.begin - Vec2::Constant(kHalf);
  const Vec2 end = band.end - Vec2::Constant(kHalf);
  const double reach = band.margin_px * (std::abs(along.x()) + std::abs(along.y()));
  const Vec2 low = begin.cwiseMin(end) - Vec2::Constant(reach);
  const Vec2 high = begin.cwiseMax(end) + Vec2::Constant(reach);
  if (!(low.cwiseAbs().maxCoeff() < 30000.0 && high.cwiseAbs().maxCoeff() < 30000.0)) return false;
  const int left = std::max(0, static_cast<int>(std::ceil(low.x())));
  const int top = std::max(0, static_cast<int>(std::ceil(low.y())));
  const int right = std::min(second_.width - kSearchSide, static_cast<int>(std::floor(high.x())));
  const int bottom = std::min(second_.height - kSearchSide, static_cast<int>(std::floor(high.y())));
  if (right < left || bottom < top) return true;
  if (right - left >= kMaxBandSide || bottom - top >= kMaxBandSide) return false;

  constexpr std::ptrdiff_t kStride = PatchSearchWorkspace::kAreaSide;
  const int width = right - left + kSearchSide;
  for (int y = 0; y < bottom - top + kSearchSide; ++y) {
    const std::uint8_t* __restrict source = second_.row(top + y) + left;
    std::int16_t* __restrict target = workspace_.area.data() + y * kStride;
    for (int x = 0; x < width; ++x) target[x] = source[x];
  }
  const int columns = right - left + 1;
  const int rows = bottom - top + 1;
  constexpr std::ptrdiff_t kScoreStride = PatchSearchWorkspace::kScoreSide;
  for (int y = 0; y < rows + 2; ++y)
    std::fill_n(workspace_.scores.data() + y * kScoreStride, columns + 2, kNotScored);
  for (int y = top; y <= bottom; ++y) {
    double lo = left;
    double hi = right;
    const double dy = y - begin.y();
    clip(along.x(), along.y() * dy - along.x() * begin.x(), -band.margin_px, length + band.margin_px, lo, hi);
    clip(across.x(), across.y() * dy - across.x() * begin.x(), -band.margin_px, band.margin_px, lo, hi);
    float* scores = workspace_.scores.data() + (y - top + 1) * kScoreStride + 1 - left;
    const std::int16_t* windows = workspace_.area.data() + (y - top) * kStride - left;
    const int last = static_cast<int>(std::floor(hi));
    for (int x = static_cast<int>(std::ceil(lo)); x <= last; ++x)
      scores[x] = correlate(patch, windows + x, kStride);
  }
  note_peaks(left, top, columns, rows);
  return true;
}

void PatchSearch::note_peaks(int left, int top, int width, int height) {
  constexpr std::ptrdiff_t kStride = PatchSearchWorkspace::kScoreSide;
  const auto vertex = [](float before, float peak, float after) {
    const float curvature = before + after - 2.0F * peak;
    return curvature < 0.0F ? std::clamp(0.5F * (before - after) / curvature, -0.5F, 0.5F) : 0.0F;
  };
  for (int y = 0; y < height; ++y) {
    const float* row = workspace_.scores.data() + (y + 1) * kStride + 1;
    for (int x = 0; x < width; ++x) {
      const float* at = row + x;
      if (*at < at[-1] || *at <= at[1] || *at < at[-kStride] || *at <= at[kStride]) continue;
      const auto [low, high] =
          std::minmax({at[-1 - kStride], at[1 - kStride], at[kStride - 1], at[kStride + 1]});
      if (*at < high || std::min({low, at[-1], at[1], at[-kStride], at[kStride]}) == kNotScored) continue;
      peaks_.push_back({Vec2(left + x + kHalf + vertex(at[-1], *at, at[1]),
                             top + y + kHalf + vertex(at[-kStride], *at, at[kStride])),
                        *at});
    }
  }
}

bool PatchSearch::find_best(FoundPatch& found) const {
  if (peaks_.empty()) return false;
  const CorrelationPeak* best = peaks_.begin();
  for (const CorrelationPeak& peak : peaks_)
    if (peak.correlation > best->correlation) best = &peak;
  found = {best->pixel, best->correlation, -1.0F};
  for (const CorrelationPeak& peak : peaks_) {
    if ((peak.pixel - best->pixel).cwiseAbs().maxCoeff() > kApart)
      found.runner_up = std::max(found.runner_up, peak.correlation);
  }
  return true;
}

}  // namespace traygauge
