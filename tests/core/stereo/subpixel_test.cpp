// Disparities between pixels: parabolas whose lowest point is known.
#include "core/stereo/subpixel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

TEST(Subpixel, FindsTheLowestPointOfAParabola) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  std::uniform_real_distribution<double> bend(2000.0, 9000.0);
  for (int i = 0; i < 2000; ++i) {
    const double lowest = place(random);
    const double curvature = bend(random);
    const auto cost = [&](double at) {
      return static_cast<int>(std::lround(500.0 + curvature * (at - lowest) * (at - lowest)));
    };
    const int offset = parabola_offset(cost(-1.0), cost(0.0), cost(1.0));
    EXPECT_NEAR(offset, kDisparityScale * lowest, 0.51);
    EXPECT_EQ(parabola_offset(cost(1.0), cost(0.0), cost(-1.0)), -offset);
  }
}

TEST(Subpixel, StaysWhereTheMiddleIsNotLowest) {
  EXPECT_EQ(parabola_offset(5, 10, 20), 0);
  EXPECT_EQ(parabola_offset(20, 10, 5), 0);
  EXPECT_EQ(parabola_offset(5, 10, 5), 0);
  EXPECT_EQ(parabola_offset(10, 10, 10), 0);
  EXPECT_EQ(parabola_offset(10, 10, 30), -kDisparityScale / 2);
  EXPECT_EQ(parabola_offset(30, 10, 10), kDisparityScale / 2);
  EXPECT_EQ(parabola_offset(0, 0, 65535), -kDisparityScale / 2);
}

}  // namespace
}  // namespace traygauge
