#include "core/paper/features/orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/image/gaussian.hpp"
#include "core/paper/features/angle.hpp"
#include "core/paper/features/haar.hpp"

namespace traygauge::paper {
namespace {

constexpr int kRadius = 6;              // in sigmas
constexpr std::size_t kSamples = 109;   // grid points with i² + j² < 36
constexpr double kResponseSigma = 2.5;  // in sigmas; [14] has 2, OpenSURF [37] 2.5
constexpr float kHaarHalf = 3.0F;       // in sigmas; [14] has 2, which gives 5% fewer correct matches
constexpr int kBins = 72;               // of 5°
constexpr int kWindowBins = 12;         // 60°

struct SampleOffset {
  int x = 0;
  int y = 0;
  float weight = 0.0F;
};

constexpr std::array<SampleOffset, kSamples> make_offsets() {
  std::array<SampleOffset, kSamples> offsets{};
  std::size_t count = 0;
  for (int y = -kRadius; y <= kRadius; ++y) {
    for (int x = -kRadius; x <= kRadius; ++x) {
      const int square = x * x + y * y;
      if (square >= kRadius * kRadius) continue;
      offsets[count++] = {x, y, static_cast<float>(gaussian(square, kResponseSigma))};
    }
  }
  return offsets;
}
constexpr std::array<SampleOffset, kSamples> kOffsets = make_offsets();

struct WeightedResponses {
  std::array<float, kSamples> dx;
  std::array<float, kSamples> dy;
};

template <bool kClamp>
void sample_responses(ImageView<const std::uint32_t> integral, const Keypoint& keypoint, int half,
                      WeightedResponses& responses) {
  const std::int32_t x = to_corner_fixed(keypoint.pixel.x());
  const std::int32_t y = to_corner_fixed(keypoint.pixel.y());
  const std::int32_t step = to_fixed_step(keypoint.scale_px);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const SampleOffset& offset = kOffsets[i];
    const HaarResponse haar = haar_response<kClamp>(integral, round_fixed(x + offset.x * step),
                                                    round_fixed(y + offset.y * step), half);
    responses.dx[i] = offset.weight * haar.dx;
    responses.dy[i] = offset.weight * haar.dy;
  }
}

struct VectorSum {
  float x = 0.0F;
  float y = 0.0F;
};

std::array<VectorSum, kBins> sum_by_angle(const WeightedResponses& responses) {
  std::array<int, kSamples> bin_of;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const float turns = angle_of(responses.dx[i], responses.dy[i]) * (0.5F / kPi);
    bin_of[i] = static_cast<int>((turns + 0.5F) * static_cast<float>(kBins));
  }
  std::array<VectorSum, kBins> bins{};
  for (std::size_t i = 0; i < kSamples; ++i) {
    VectorSum& bin = bins[static_cast<std::size_t>(std::clamp(bin_of[i], 0, kBins - 1))];
    bin.x += responses.dx[i];
    bin.y += responses.dy[i];
  }
  return bins;
}

VectorSum find_longest_window(const std::array<VectorSum, kBins>& bins) {
  VectorSum window;
  for (std::size_t i = 0; i < kWindowBins; ++i) {
    window.x += bins[i].x;
    window.y += bins[i].y;
  }
  VectorSum longest = window;
  for (std::size_t begin = 0; begin < kBins; ++begin) {
    const VectorSum& enters = bins[(begin + kWindowBins) % kBins];
    window.x += enters.x - bins[begin].x;
    window.y += enters.y - bins[begin].y;
    const float square = window.x * window.x + window.y * window.y;
    if (square > longest.x * longest.x + longest.y * longest.y) longest = window;
  }
  return longest;
}

}  // namespace

Direction find_orientation(ImageView<const std::uint32_t> integral, const Keypoint& keypoint) {
  const int half = std::max(1, static_cast<int>(kHaarHalf * keypoint.scale_px + 0.5F));
  const double reach = kRadius * static_cast<double>(keypoint.scale_px) + half;
  WeightedResponses responses;
  if (fits_inside(integral, keypoint.pixel.x(), keypoint.pixel.y(), reach)) {
    sample_responses<false>(integral, keypoint, half, responses);
  } else {
    sample_responses<true>(integral, keypoint, half, responses);
  }
  const VectorSum sum = find_longest_window(sum_by_angle(responses));
  const float length = std::sqrt(sum.x * sum.x + sum.y * sum.y);
  if (!(length > 0.0F)) return {};
  return {sum.x / length, sum.y / length};
}

}  // namespace traygauge::paper
