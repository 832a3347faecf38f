#include "drivers/gpio/step_profile.hpp"

#include <gtest/gtest.h>

#include <random>

namespace traygauge {
namespace {

TEST(StepProfile, RampsCruisesAndRampsDown) {
  const StepProfile profile(1000, 200.0, 400.0);  // ramps: half a second, 50 steps each
  EXPECT_NEAR(profile.time_s(50), 0.5, 1e-9);
  EXPECT_NEAR(profile.time_s(250), 0.5 + 1.0, 1e-9);
  EXPECT_NEAR(profile.time_s(950), 0.5 + 4.5, 1e-9);
  EXPECT_NEAR(profile.duration_s(), 5.5, 1e-9);
  EXPECT_NEAR(profile.time_s(1000), 5.5, 1e-9);
}

TEST(StepProfile, AShortMoveTurnsRoundHalfWay) {
  const StepProfile profile(20, 200.0, 400.0);
  EXPECT_NEAR(profile.time_s(10), profile.duration_s() / 2.0, 1e-9);
  EXPECT_NEAR(profile.duration_s(), 2.0 * std::sqrt(2.0 * 10.0 / 400.0), 1e-9);
}

TEST(StepProfile, NeverExceedsSpeedAndAccelerationOnAnyMove) {
  std::mt19937 random(20261122);
  for (int run = 0; run < 300; ++run) {
    const auto steps = std::uniform_int_distribution<std::int64_t>(1, 3000)(random);
    const double speed = std::uniform_real_distribution<>(10.0, 5000.0)(random);
    const double acceleration = std::uniform_real_distribution<>(10.0, 50'000.0)(random);
    const StepProfile profile(steps, speed, acceleration);
    const double least = 1.0 / speed * (1.0 - 1e-9);
    double last = 0.0;
    for (std::int64_t i = 1; i <= steps; ++i) {
      const double time = profile.time_s(i);
      ASSERT_GE(time - last, least) << "run " << run << " step " << i << " of " << steps;
      // From standing, i steps take at least sqrt(2 i / a); so does what is left.
      ASSERT_GE(time * (1.0 + 1e-9), std::sqrt(2.0 * static_cast<double>(i) / acceleration));
      ASSERT_GE((profile.duration_s() - time) * (1.0 + 1e-6) + 1e-9,
                std::sqrt(2.0 * static_cast<double>(steps - i) / acceleration) * (1.0 - 1e-6));
      last = time;
    }
    ASSERT_NEAR(last, profile.duration_s(), 1e-9);
  }
}

TEST(StepProfile, NoStepsTakeNoTime) {
  EXPECT_EQ(StepProfile(0, 100.0, 100.0).duration_s(), 0.0);
}

}  // namespace
}  // namespace traygauge
