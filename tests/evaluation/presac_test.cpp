// Preemptive RANSAC on exact scenes with noise and outliers.
#include "tests/evaluation/methods/presac.hpp"

#include <gtest/gtest.h>

#include "tests/core/paper/motion_scenes.hpp"

namespace traygauge::tables {
namespace {

TEST(Presac, HalvesItsHypothesesAfterEveryBlock) {
  EXPECT_EQ(kept_hypotheses(500, 100, 0), 500);
  EXPECT_EQ(kept_hypotheses(500, 100, 99), 500);
  EXPECT_EQ(kept_hypotheses(500, 100, 100), 250);
  EXPECT_EQ(kept_hypotheses(500, 100, 399), 62);
  EXPECT_EQ(kept_hypotheses(500, 100, 800), 1);
  EXPECT_EQ(kept_hypotheses(500, 100, 900), 0);
  EXPECT_EQ(kept_hypotheses(500, 1, 40), 0);
}

// Unrefined: the best of many samples of five.
TEST(Presac, FindsTheMotionAmongOutliers) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    traygauge::test::TrayOptions options;
    options.angle_deg = 20.0;
    options.noise_px = 0.3;
    options.outlier_fraction = 0.3;
    const auto scene = traygauge::test::tray_scene(seed, options);
    Random random(seed);
    Presac presac;
    Pose found;
    ASSERT_TRUE(presac.find_motion(scene.matches, traygauge::test::kFocalPx, random, found))
        << "seed " << seed;
    EXPECT_LT(traygauge::test::rotation_error_deg(found, scene.second_from_first), 1.0) << "seed " << seed;
    EXPECT_LT(traygauge::test::direction_error_deg(found, scene.second_from_first), 3.0) << "seed " << seed;
  }
}

TEST(Presac, ExactMatchesGiveTheExactMotion) {
  const auto scene = traygauge::test::tray_scene(3, {});
  Random random(1);
  Presac presac;
  Pose found;
  ASSERT_TRUE(presac.find_motion(scene.matches, traygauge::test::kFocalPx, random, found));
  EXPECT_LT(traygauge::test::rotation_error_deg(found, scene.second_from_first), 1e-3);
  EXPECT_LT(traygauge::test::direction_error_deg(found, scene.second_from_first), 1e-2);
}

TEST(Presac, SaysWhenThereIsNothingToFind) {
  Random random(1);
  Presac presac;
  Pose found;
  const std::vector<RayMatch> few(4);
  EXPECT_FALSE(presac.find_motion(few, 1000.0, random, found));
  const std::vector<RayMatch> equal(40);
  EXPECT_FALSE(presac.find_motion(equal, 1000.0, random, found));
}

}  // namespace
}  // namespace traygauge::tables
