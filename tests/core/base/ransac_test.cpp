#include "core/base/ransac.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace traygauge {
namespace {

TEST(SampleDistinct, DrawsEachSetEquallyOften) {
  constexpr std::size_t kPopulation = 6;
  constexpr int kDraws = 40000;
  Random random(1);
  std::vector<int> hits(1U << kPopulation);
  for (int draw = 0; draw < kDraws; ++draw) {
    unsigned members = 0;
    for (const std::size_t i : sample_distinct<3>(random, kPopulation)) {
      ASSERT_LT(i, kPopulation);
      members |= 1U << i;
    }
    ++hits[members];
  }
  int sets = 0;
  for (const int count : hits) {
    if (count == 0) continue;
    ++sets;
    EXPECT_NEAR(count, kDraws / 20.0, 5.0 * std::sqrt(kDraws / 20.0));
  }
  EXPECT_EQ(sets, 20);  // subsets of three out of six: a repeated index would make another, smaller one
}

TEST(SampleDistinct, TakesAllWhenThereAreNoMore) {
  Random random(2);
  std::vector<std::size_t> sample(9);
  sample_distinct(random, sample.size(), sample);
  EXPECT_EQ(std::set<std::size_t>(sample.begin(), sample.end()).size(), sample.size());
}

int iterations_at(double inlier_rate, std::size_t sample_size, int min_iterations, int max_iterations) {
  IterationBound bound(0.99, min_iterations, max_iterations);
  for (; bound.proceed(); bound.count_iteration()) {
    if (bound.iterations() == 0) bound.update(inlier_rate, sample_size);
  }
  return bound.iterations();
}

// Fischler & Bolles: log(1 - confidence) / log(1 - rate^size) samples.
TEST(IterationBound, FollowsTheLogarithmicFormula) {
  for (const double rate : {0.2, 0.5, 0.7, 0.9}) {
    for (const std::size_t size : {3U, 4U, 5U}) {
      const double exact = std::log(1.0 - 0.99) / std::log(1.0 - std::pow(rate, static_cast<double>(size)));
      EXPECT_EQ(iterations_at(rate, size, 0, 1000000), static_cast<int>(std::ceil(exact)))
          << rate << " of samples of " << size;
    }
  }
}

TEST(IterationBound, KeepsItsLimits) {
  EXPECT_EQ(iterations_at(1.0, 4, 0, 100), 1);
  EXPECT_EQ(iterations_at(1.0, 4, 30, 100), 30);
  EXPECT_EQ(iterations_at(0.01, 4, 30, 100), 100);
  EXPECT_EQ(iterations_at(0.0, 4, 30, 100), 100);
  EXPECT_EQ(iterations_at(1.0, 4, 200, 100), 100);
}

// The bound counts what was drawn before the model was found, and follows a rate that falls again.
TEST(IterationBound, ALateModelEndsTheSearchOnceEnoughWasDrawn) {
  IterationBound bound(0.99, 0, 1000);
  while (bound.iterations() < 50) bound.count_iteration();
  bound.update(0.9, 4);
  EXPECT_FALSE(bound.proceed());
  bound.update(0.3, 4);
  EXPECT_TRUE(bound.proceed());
}

}  // namespace
}  // namespace traygauge
