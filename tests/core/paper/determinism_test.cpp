#include <gtest/gtest.h>

#include "tests/core/paper/paper_bench.hpp"

namespace traygauge::paper {
namespace {

TEST(Determinism, SameSeedSameBits) {
  MeasuringBench bench(configuration_of(default_tray()));
  const auto once = numbers_of(bench.measure(default_tray(), 5));
  const auto twice = numbers_of(bench.measure(default_tray(), 5));
  EXPECT_EQ(once.front(), static_cast<double>(StatusCode::ok));
  EXPECT_TRUE(have_equal_bits(once, twice));
}

TEST(Determinism, EstimatingAgainNeedsNoNewViews) {
  MeasuringBench bench(configuration_of(default_tray()));
  const auto first = numbers_of(bench.measure(default_tray(), 5));
  const auto other_seed = numbers_of(bench.estimator.estimate(6));
  const auto again = numbers_of(bench.estimator.estimate(5));
  EXPECT_TRUE(have_equal_bits(first, again));
  EXPECT_TRUE(have_equal_bits(other_seed, numbers_of(bench.measure(default_tray(), 6))));
}

TEST(Determinism, TwoEstimatorsAgree) {
  MeasuringBench one(configuration_of(default_tray()));
  MeasuringBench two(configuration_of(default_tray()));
  static_cast<void>(two.measure(other_tray(), 9));
  EXPECT_TRUE(have_equal_bits(numbers_of(one.measure(default_tray(), 5)),
                              numbers_of(two.measure(default_tray(), 5))));
}

TEST(Determinism, NothingLeaksFromOneMeasurementIntoTheNext) {
  MeasuringBench bench(configuration_of(default_tray()));
  const auto before = numbers_of(bench.measure(default_tray(), 5));
  const auto between = numbers_of(bench.measure(other_tray(), 5));
  EXPECT_FALSE(have_equal_bits(before, between));
  const Measurement& refused = bench.measure(default_tray().view(0), other_tray().view(1), 5);
  EXPECT_FALSE(refused.status.ok());
  EXPECT_TRUE(have_equal_bits(before, numbers_of(bench.measure(default_tray(), 5))));
}

// The seed must be really used: some number of ten runs differs.
TEST(Determinism, OtherSeedsDrawOtherSamples) {
  MeasuringBench bench(configuration_of(default_tray()));
  const auto reference = numbers_of(bench.measure(default_tray(), 1));
  int different = 0;
  for (std::uint64_t seed = 2; seed <= 10; ++seed) {
    const Measurement& measurement = bench.estimator.estimate(seed);
    ASSERT_TRUE(measurement.status.ok());
    EXPECT_NEAR(measurement.items[0].volume_ml, default_tray().volume_ml(),
                0.04 * default_tray().volume_ml());
    if (!have_equal_bits(reference, numbers_of(measurement))) ++different;
  }
  EXPECT_GE(different, 5);
}

}  // namespace
}  // namespace traygauge::paper
