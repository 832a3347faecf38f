#include "simulator/scenes/monotone_cubic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace traygauge {
namespace {

// The outer part of a dinner plate.
TEST(MonotoneCubic, TurnsAroundAtTheRimWithoutOvershoot) {
  const MonotoneCubic curve({0.0, 1.6, 4.5, 28.0, 36.0}, {21.4, 22.0, 21.4, 15.5, 11.0});
  EXPECT_DOUBLE_EQ(curve.value(1.6), 22.0);
  EXPECT_DOUBLE_EQ(curve.slope(1.6), 0.0);
  for (double x = 0.0; x <= 36.0; x += 0.01) {
    EXPECT_LE(curve.value(x), 22.0);
    EXPECT_GE(curve.value(x), 11.0);
    if (x > 1.6 && x < 36.0) {
      EXPECT_LE(curve.slope(x), 1e-12) << x;
    }
  }
}

// Monotone data on a parabola's rising half: the interpolant stays close to it and its slope is its
// derivative.
TEST(MonotoneCubic, FollowsASmoothCurve) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i <= 20; ++i) {
    x.push_back(0.5 * i);
    y.push_back(std::exp(0.3 * x.back()));
  }
  const MonotoneCubic curve(x, y);
  for (double at = 0.6; at < 9.4; at += 0.07) {
    EXPECT_NEAR(curve.value(at), std::exp(0.3 * at), 2e-3 * std::exp(0.3 * at)) << at;
    const double step = 1e-6;
    EXPECT_NEAR(curve.slope(at), (curve.value(at + step) - curve.value(at - step)) / (2.0 * step), 1e-5)
        << at;
  }
}

TEST(MonotoneCubic, IsConstantBeyondItsEnds) {
  const MonotoneCubic curve({0.0, 2.0}, {5.0, 9.0});
  EXPECT_DOUBLE_EQ(curve.value(-1.0), 5.0);
  EXPECT_DOUBLE_EQ(curve.value(1.0), 7.0);
  EXPECT_DOUBLE_EQ(curve.value(3.0), 9.0);
  EXPECT_DOUBLE_EQ(curve.slope(3.0), 0.0);
}

}  // namespace
}  // namespace traygauge
