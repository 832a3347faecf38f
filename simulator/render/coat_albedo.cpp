#include "simulator/render/coat_albedo.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "simulator/render/ggx.hpp"
#include "simulator/render/sample_sequence.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kCosines = 33;
constexpr std::size_t kAlphas = 17;
constexpr std::uint32_t kSamples = 1024;

// Schlick's Fresnel term is linear in the coat's share, so its integral is constant + coat · slope.
struct Line {
  float constant = 0.0F;
  float slope = 0.0F;
};

Line operator+(const Line& a, const Line& b) {
  return {a.constant + b.constant, a.slope + b.slope};
}
Line operator*(float factor, const Line& a) {
  return {factor * a.constant, factor * a.slope};
}

Line integrate(float cosine, float alpha) {
  const SampleSequence sequence(1);
  const Eigen::Vector3f viewer(std::sqrt(1.0F - cosine * cosine), 0.0F, cosine);
  Line sum;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Eigen::Vector3f half = ggx::visible_normal(viewer, alpha, sequence.point(0, i));
    const float half_cosine = half.dot(viewer);
    const float light_cosine = 2.0F * half_cosine * half.z() - viewer.z();
    if (light_cosine <= 0.0F) continue;
    const float weight = ggx::seen_both_ways(cosine, light_cosine, alpha) / ggx::seen(cosine, alpha);
    const float grazing = std::pow(1.0F - half_cosine, 5.0F);
    sum = sum + Line{weight * grazing, weight * (1.0F - grazing)};
  }
  return (1.0F / static_cast<float>(kSamples)) * sum;
}

// Cosines and alphas are finer near 0, where the albedo bends.
struct Table {
  Table() {
    for (std::size_t a = 0; a < kAlphas; ++a) {
      const float alpha = std::max(square(a, kAlphas), 1e-4F);
      for (std::size_t c = 0; c < kCosines; ++c) {
        lines[a][c] = integrate(std::max(square(c, kCosines), 1e-3F), alpha);
      }
      for (std::size_t c = 0; c + 1 < kCosines; ++c) {
        // Between two cosines: their mean, weighed by 2 cos d cos.
        const float share =
            square(c + 1, kCosines) * square(c + 1, kCosines) - square(c, kCosines) * square(c, kCosines);
        means[a] = means[a] + (0.5F * share) * (lines[a][c] + lines[a][c + 1]);
      }
    }
  }

  static float square(std::size_t index, std::size_t count) {
    const float share = static_cast<float>(index) / static_cast<float>(count - 1);
    return share * share;
  }

  std::array<std::array<Line, kCosines>, kAlphas> lines{};
  std::array<Line, kAlphas> means{};
};

const Table& table() {
  static const Table instance;
  return instance;
}

struct Place {
  std::size_t index = 0;
  float share = 0.0F;
};

Place place_of(float value, std::size_t count) {
  const float scaled = std::sqrt(std::clamp(value, 0.0F, 1.0F)) * static_cast<float>(count - 1);
  const std::size_t index = std::min(static_cast<std::size_t>(scaled), count - 2);
  return {index, scaled - static_cast<float>(index)};
}

Line between(const Line& a, const Line& b, float share) {
  return (1.0F - share) * a + share * b;
}

}  // namespace

CoatAlbedo::CoatAlbedo(float coat, float alpha) : coat_(coat) {
  const Place place = place_of(alpha, kAlphas);
  row_ = place.index;
  row_fraction_ = place.share;
  const Line line = between(table().means[row_], table().means[row_ + 1], row_fraction_);
  mean_ = line.constant + coat * line.slope;
}

float CoatAlbedo::at(float cosine) const {
  const Place c = place_of(cosine, kCosines);
  const auto& lines = table().lines;
  const Line low = between(lines[row_][c.index], lines[row_][c.index + 1], c.share);
  const Line high = between(lines[row_ + 1][c.index], lines[row_ + 1][c.index + 1], c.share);
  const Line line = between(low, high, row_fraction_);
  return line.constant + coat_ * line.slope;
}

}  // namespace traygauge
