// Rendered captures with exact truth, real detection noise: SIFT matches, true relative poses.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/card/card_detection.hpp"
#include "core/card/card_pose.hpp"
#include "core/paper/card/card_scale.hpp"
#include "tests/core/paper/card_capture.hpp"

namespace traygauge::paper {
namespace {

struct Pair {
  const char* capture;
  std::size_t first;
  std::size_t second;
};

class CardCaptures : public ::testing::TestWithParam<Pair> {};

TEST_P(CardCaptures, ScaleWithinOnePercentAndPlaneOnTheTable) {
  const std::filesystem::path captures = test::captures_folder();
  if (captures.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  const Pair& pair = GetParam();
  const CardCapture capture = load_card_capture(captures / pair.capture, {pair.first, pair.second});
  const CardScene scene = load_card_scene(capture, 0, 1);
  test::Allocated<CardScaleWorkspace> memory(kMaxCaptureFeatures);
  Random random(1);
  const CardScaleParams params;
  CardFit fit;
  ASSERT_TRUE(find_card(scene.tracks, capture.size, params, random, *memory, fit).ok());
  EXPECT_GE(fit.inlier_count, 20);
  for (const Vec2& corner : {Vec2(5.0, 5.0), Vec2(80.0, 50.0)}) {
    Vec2 mapped = Vec2::Zero();
    const Vec2 ray = project(scene.first_from_card, corner);
    ASSERT_TRUE((fit.pattern_from_first * ray.homogeneous()).z() > 0.0);
    mapped = (fit.pattern_from_first * ray.homogeneous()).hnormalized();
    EXPECT_LT((mapped - corner).norm(), 0.4) << "mm, near the card's corners";
  }
  ScaleEstimate scale;
  ASSERT_TRUE(estimate_scale(scene.tracks, fit.inliers, capture.size.length_mm(), params.scale, random,
                             *memory, scale)
                  .ok());
  EXPECT_NEAR(scale.mm_per_baseline / scene.baseline_mm, 1.0, 0.01);
  Plane plane;
  ASSERT_TRUE(fit_card_plane(scene.tracks, fit.inliers, capture.size.length_mm(), scale.mm_per_baseline,
                             params.plane, random, *memory, plane)
                  .ok());
  const Vec3 centre = scene.first_from_card * Vec3(42.8, 26.99, 0.0);
  const double tilt =
      std::asin(std::min(1.0, plane.normal.cross(scene.first_from_card.rotation.col(2)).norm()));
  EXPECT_LT(std::abs(plane.height(centre)), 0.01 * centre.norm());
  EXPECT_LT(tilt, 0.02);
  std::cout << pair.capture << ": " << fit.inlier_count << " of " << scene.tracks.size() << " tracks, rms "
            << fit.rms_mm << " mm, scale " << 100.0 * (scale.mm_per_baseline / scene.baseline_mm - 1.0)
            << " %, plane " << plane.height(centre) << " mm, " << tilt * 180.0 / std::numbers::pi << " deg\n";
}

INSTANTIATE_TEST_SUITE_P(Sets, CardCaptures,
                         ::testing::Values(Pair{"meals/m04", 0, 1}, Pair{"meals/m11", 0, 2},
                                           Pair{"trays/t01", 0, 1}, Pair{"angles/a01", 0, 3}));

// The card's own pattern is missing: another card's pattern matches nothing that could pass for it.
TEST(CardCapturesWithoutCard, AnotherPatternIsNotFound) {
  const std::filesystem::path captures = test::captures_folder();
  if (captures.empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
  CardCapture capture = load_card_capture(captures / "meals/m08", {0, 1});
  std::mt19937 generator(1);
  std::shuffle(capture.pattern_mm.begin(), capture.pattern_mm.end(),
               generator);  // a pattern of the same marks
  const CardScene scene = load_card_scene(capture, 0, 1);
  test::Allocated<CardScaleWorkspace> memory(kMaxCaptureFeatures);
  EXPECT_GT(scene.tracks.size(), 20U);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    CardFit fit;
    EXPECT_EQ(find_card(scene.tracks, capture.size, {}, random, *memory, fit).code(),
              StatusCode::card_not_found)
        << "seed " << seed;
  }
}

}  // namespace
}  // namespace traygauge::paper
