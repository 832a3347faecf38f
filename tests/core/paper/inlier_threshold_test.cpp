#include "core/paper/pose/inlier_threshold.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.hpp"

namespace traygauge::paper {
namespace {

struct Distances {
  std::vector<double> data;
  std::vector<double> noise;
};

// Inliers within about 1 px, the rest and the noise up to 500 px; on a grid, so that ties occur.
Distances draw_distances(std::uint64_t seed, int count, double inlier_rate) {
  Random random(seed);
  Distances d;
  const auto gridded = [](double value) { return std::round(value * 16.0) / 16.0; };
  for (int i = 0; i < count; ++i) {
    const bool is_inlier = random.uniform() < inlier_rate;
    d.data.push_back(gridded(random.uniform() * (is_inlier ? 1.0 : 500.0)));
  }
  for (int i = 0; i < 1000; ++i) d.noise.push_back(gridded(random.uniform() * 500.0));
  return d;
}

double share_up_to(const std::vector<double>& values, double limit) {
  std::size_t count = 0;
  for (const double v : values) count += v <= limit ? 1U : 0U;
  return static_cast<double>(count);
}

TEST(FalseDiscovery, IsTheLargestInlierRateUnderTheBound) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Distances d =
        draw_distances(seed, 50 + static_cast<int>(seed), 0.1 + 0.003 * static_cast<double>(seed));
    double expected = -1.0;  // straight from the definition
    for (const double t : d.data) {
      const double noise = (share_up_to(d.noise, t) + 1.0) / (static_cast<double>(d.noise.size()) + 1.0);
      const double data = share_up_to(d.data, t) / static_cast<double>(d.data.size());
      if (t <= 10.0 && noise < 0.03 * data) expected = std::max(expected, t);
    }
    Distances scratch = d;
    EXPECT_EQ(false_discovery_threshold_px(scratch.data, scratch.noise, 0.03, 10.0), expected)
        << "seed " << seed;
  }
}

TEST(FalseDiscovery, TrustsNoHandfulOfMatchesInNoise) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Distances d = draw_distances(seed, 1000, 0.0);
    for (std::size_t i = 0; i < 5; ++i) d.data[i] = 0.0;  // the model's own sample
    EXPECT_LT(false_discovery_threshold_px(d.data, d.noise, 0.03, 10.0), 0.0) << "seed " << seed;
  }
}

TEST(FalseDiscovery, ASmallerBoundNeverWidensTheThreshold) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Distances d = draw_distances(seed, 400, 0.5);
    double last = -1.0;
    for (const double share : {0.002, 0.01, 0.03, 0.1}) {
      Distances scratch = d;
      const double threshold = false_discovery_threshold_px(scratch.data, scratch.noise, share, 10.0);
      EXPECT_GE(threshold, last) << "seed " << seed;
      last = threshold;
    }
    EXPECT_GT(last, 0.5);
  }
}

TEST(FalseDiscovery, EmptyInputHasNoThreshold) {
  std::vector<double> noise = {1.0, 2.0};
  EXPECT_LT(false_discovery_threshold_px({}, noise, 0.03, 10.0), 0.0);
}

TEST(AContrario, MinimisesTheNumberOfFalseAlarms) {
  std::vector<double> log_factorials(1001);
  fill_log_factorials(log_factorials);
  AContrarioModel model;
  model.band_probability_per_px = 2.0 * 2000.0 / (1600.0 * 1200.0);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Distances d =
        draw_distances(seed, 60 + static_cast<int>(seed), 0.1 + 0.004 * static_cast<double>(seed));
    std::vector<double> sorted = d.data;
    std::sort(sorted.begin(), sorted.end());
    const auto n = static_cast<double>(sorted.size());
    double best = 0.0;  // eq. 3 of Moisan et al., by the library's lgamma
    double expected = -1.0;
    for (std::size_t k = 6; k <= sorted.size() && sorted[k - 1] <= 10.0; ++k) {
      const auto m = static_cast<double>(k);
      const double log_alpha = std::log(std::max(sorted[k - 1] * model.band_probability_per_px, 1e-12));
      const double log_nfa = std::log(10.0 * (n - 5.0)) + std::lgamma(n + 1) - std::lgamma(m + 1) -
                             std::lgamma(n - m + 1) + std::lgamma(m + 1) - std::lgamma(6.0) -
                             std::lgamma(m - 4.0) + (m - 5.0) * log_alpha;
      if (log_nfa < best) {
        best = log_nfa;
        expected = sorted[k - 1];
      }
    }
    std::vector<double> scratch = d.data;
    EXPECT_EQ(a_contrario_threshold_px(scratch, model, log_factorials, 10.0), expected) << "seed " << seed;
  }
}

TEST(AContrario, FindsNoModelInNoise) {
  std::vector<double> log_factorials(1001);
  fill_log_factorials(log_factorials);
  AContrarioModel model;
  model.band_probability_per_px = 1.0 / 500.0;  // the law of the noise below
  int found = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Distances d = draw_distances(seed, 200, 0.0);
    found += a_contrario_threshold_px(d.data, model, log_factorials, 10.0) >= 0.0 ? 1 : 0;
  }
  EXPECT_LE(found, 1);  // expected: below one false alarm in as many tests as a search makes
}

TEST(AContrario, LogFactorialsAreThoseOfTheLibrary) {
  std::vector<double> values(3001);
  fill_log_factorials(values);
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double expected = std::lgamma(static_cast<double>(n) + 1.0);
    ASSERT_NEAR(values[n], expected, 1e-12 * std::max(expected, 1.0)) << n;
  }
}

}  // namespace
}  // namespace traygauge::paper
