#include "tests/evaluation/methods/presac.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/ransac.hpp"
#include "core/geometry/triangulation.hpp"
#include "core/paper/pose/epipolar.hpp"
#include "core/paper/pose/essential_decomposition.hpp"
#include "core/paper/pose/five_point.hpp"

namespace traygauge::tables {
namespace {

constexpr std::size_t kSample = 5;

struct Hypothesis {
  Mat3 essential = Mat3::Zero();
  double score = 0.0;
};

std::vector<Hypothesis> draw_hypotheses(std::span<const RayMatch> matches, std::size_t wanted,
                                        Random& random) {
  std::vector<Hypothesis> hypotheses;
  std::array<Mat3, paper::kMaxEssentials> models;
  // Samples in special position give no model; not all can be such.
  for (std::size_t draws = 0; hypotheses.size() < wanted && draws < 2 * wanted; ++draws) {
    std::array<RayMatch, kSample> sample;
    const auto drawn = sample_distinct<kSample>(random, matches.size());
    for (std::size_t k = 0; k < kSample; ++k) sample[k] = matches[drawn[k]];
    const int count = paper::solve_five_point(sample, models);
    for (int m = 0; m < count && hypotheses.size() < wanted; ++m)
      hypotheses.push_back({models[static_cast<std::size_t>(m)]});
  }
  return hypotheses;
}

std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  return order;
}

// Of the four motions of an essential matrix, the one with most matches in front of both cameras.
bool choose_motion(const Mat3& essential, std::span<const RayMatch> matches, double focal_px,
                   double threshold_px, Pose& motion) {
  std::size_t most = 0;
  for (const Pose& candidate : paper::decompose_essential(essential)) {
    const auto in_front = [&](const RayMatch& match) {
      Vec3 point;
      return paper::symmetric_epipolar_distance_px(essential, match, focal_px) <= threshold_px &&
             triangulate(match, candidate, point);
    };
    const auto count = static_cast<std::size_t>(std::count_if(matches.begin(), matches.end(), in_front));
    if (count <= most) continue;
    most = count;
    motion = candidate;
  }
  return most > kSample;
}

}  // namespace

int kept_hypotheses(int hypotheses, int block, int scored) {
  const int halvings = scored / block;
  return halvings < 31 ? hypotheses >> halvings : 0;
}

bool Presac::find_motion(std::span<const RayMatch> matches, double focal_px, Random& random,
                         Pose& second_from_first) {
  if (matches.size() < kSample) return false;
  auto hypotheses = draw_hypotheses(matches, static_cast<std::size_t>(params_.hypotheses), random);
  if (hypotheses.empty()) return false;
  const double inverse_scale = 1.0 / params_.scale_px;
  int scored = 0;
  for (const std::size_t i : shuffled(matches.size(), random)) {
    for (Hypothesis& own : hypotheses) {
      // The logarithm of a Cauchy distribution, as Nistér scores.
      const double distance =
          paper::symmetric_epipolar_distance_px(own.essential, matches[i], focal_px) * inverse_scale;
      own.score -= std::log1p(distance * distance);
    }
    const auto kept =
        static_cast<std::size_t>(std::max(1, kept_hypotheses(params_.hypotheses, params_.block, ++scored)));
    if (kept >= hypotheses.size()) continue;
    const auto end = hypotheses.begin() + static_cast<std::ptrdiff_t>(kept);
    std::nth_element(hypotheses.begin(), end, hypotheses.end(),
                     [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
    hypotheses.erase(end, hypotheses.end());
    if (kept == 1) break;
  }
  const auto best =
      std::max_element(hypotheses.begin(), hypotheses.end(),
                       [](const Hypothesis& a, const Hypothesis& b) { return a.score < b.score; });
  return choose_motion(best->essential, matches, focal_px, params_.scale_px, second_from_first);
}

}  // namespace traygauge::tables
