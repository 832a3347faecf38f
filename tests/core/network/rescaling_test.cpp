// Rounding and saturation by closed forms.
#include "core/network/rescaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

TEST(Rescaling, RoundsToTheNearestHalvesUpward) {
  constexpr std::int32_t kQuarter = std::int32_t{1} << 28U;
  constexpr int kShift = 30;
  EXPECT_EQ(rescale(1, kQuarter, kShift), 0);
  EXPECT_EQ(rescale(2, kQuarter, kShift), 1);  // 0.5
  EXPECT_EQ(rescale(3, kQuarter, kShift), 1);
  EXPECT_EQ(rescale(-1, kQuarter, kShift), 0);
  EXPECT_EQ(rescale(-2, kQuarter, kShift), 0);  // -0.5
  EXPECT_EQ(rescale(-3, kQuarter, kShift), -1);
  EXPECT_EQ(rescale(-6, kQuarter, kShift), -1);  // -1.5
  EXPECT_EQ(rescale(6, kQuarter, kShift), 2);    // 1.5
}

// The floor of the exact quotient and a half, where a double holds the product exactly.
TEST(Rescaling, IsTheFloorOfTheQuotientAndAHalf) {
  std::mt19937_64 random(test::random_seed());
  for (int i = 0; i < 20000; ++i) {
    const auto sum = static_cast<std::int32_t>(random());
    const auto multiplier = static_cast<std::int32_t>(random() % (std::uint64_t{1} << 21U)) + 1;
    const int shift = std::uniform_int_distribution<int>(kMinRescalingShift, kMaxRescalingShift)(random);
    // Below 2^52; near a half, where the sum decides, it is exact as well.
    const double quotient = std::ldexp(static_cast<double>(sum) * multiplier, -shift);
    EXPECT_EQ(static_cast<double>(rescale(sum, multiplier, shift)), std::floor(quotient + 0.5))
        << sum << " * " << multiplier << " >> " << shift;
  }
}

TEST(Rescaling, TakesTheLargestNumbers) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  EXPECT_EQ(rescale(kMost, kMost, 62), 1);
  EXPECT_EQ(rescale(kLeast, kMost, 62), -1);
  EXPECT_EQ(rescale(kMost, kMost, 31), kMost - 1);  // 2^31 - 2 + 2^-31
  EXPECT_EQ(rescale(kLeast, 1, 1), kLeast / 2);
}

TEST(Rescaling, SaturatesAtTheEndsOfAByte) {
  EXPECT_EQ(saturate(-1, true), 0);
  EXPECT_EQ(saturate(0, true), 0);
  EXPECT_EQ(saturate(255, true), 255);
  EXPECT_EQ(saturate(256, true), 255);
  EXPECT_EQ(saturate(std::int64_t{1} << 60U, true), 255);
  EXPECT_EQ(static_cast<std::int8_t>(saturate(-129, false)), -128);
  EXPECT_EQ(static_cast<std::int8_t>(saturate(-128, false)), -128);
  EXPECT_EQ(static_cast<std::int8_t>(saturate(-1, false)), -1);
  EXPECT_EQ(static_cast<std::int8_t>(saturate(127, false)), 127);
  EXPECT_EQ(static_cast<std::int8_t>(saturate(128, false)), 127);
}

}  // namespace
}  // namespace traygauge
