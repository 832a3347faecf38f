#include "core/paper/card/card_scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/card/card_detection.hpp"
#include "core/paper/card/card_tracks.hpp"
#include "tests/core/card/synthetic_card.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

class Scale : public testing::Test {
 protected:
  Status estimate(const CardScene& scene, const ScaleParams& params = {}, unsigned seed = 1) {
    Random random(seed);
    const Status found = find_card(scene.tracks, size_, {}, random, *memory_, fit_);
    if (!found.ok()) return found;
    return estimate_scale(scene.tracks, fit_.inliers, size_.length_mm(), params, random, *memory_, estimate_);
  }
  Status fit_plane(const CardScene& scene, Plane& plane) {
    Random random(5);
    return fit_card_plane(scene.tracks, fit_.inliers, size_.length_mm(), scene.baseline_mm, {}, random,
                          *memory_, plane);
  }
  // Of the card's true centre and of the direction of the true normal.
  static void plane_errors(const CardScene& scene, const Plane& plane, double& height_mm, double& angle_deg) {
    height_mm = plane.height(scene.first_from_card * Vec3(42.8, 26.99, 0.0));
    const double sine = plane.normal.cross(scene.first_from_card.rotation.col(2)).norm();
    angle_deg = std::asin(std::min(1.0, sine)) * 180.0 / std::numbers::pi;
  }
  test::Allocated<CardScaleWorkspace> memory_{1500};
  CardModelSize size_;
  CardFit fit_;
  ScaleEstimate estimate_;
};

TEST_F(Scale, ExactCardsGiveTheBaselineAndThePlane) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const CardScene scene = make_card_scene(random, {.count = 30});
    ASSERT_TRUE(estimate(scene).ok());
    EXPECT_NEAR(estimate_.mm_per_baseline, scene.baseline_mm, 1e-5 * scene.baseline_mm);
    EXPECT_LT(estimate_.spread, 1e-8);
    Plane plane;
    ASSERT_TRUE(fit_plane(scene, plane).ok());
    EXPECT_GT(plane.height(Vec3::Zero()), 0.0);
    for (const CardTrack& track : scene.tracks) {
      const Vec3 point(track.pattern_mm.x(), track.pattern_mm.y(), 0.0);
      EXPECT_NEAR(plane.height(scene.first_from_card * point), 0.0, 1e-5);
    }
    const Vec3 below = scene.first_from_card * Vec3(40.0, 20.0, size_.thickness_mm);
    EXPECT_NEAR(plane.raised(-size_.thickness_mm).height(below), 0.0, 1e-5)
        << "the table lies under the card";
  }
}

// 0.3 px at f = 1400 px, 15 cm apart, 50 cm away, half of the matches wrong.
TEST_F(Scale, ScaleAndPlaneUnderNoiseAndOutliers) {
  std::vector<double> errors;
  std::vector<double> heights;
  std::vector<double> angles;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const CardScene scene = make_card_scene(random, {.count = 160, .noise_px = 0.3, .outlier_fraction = 0.5});
    ASSERT_TRUE(estimate(scene, {}, seed).ok());
    errors.push_back(std::abs(estimate_.mm_per_baseline / scene.baseline_mm - 1.0));
    Plane plane;
    ASSERT_TRUE(fit_plane(scene, plane).ok());
    double height = 0.0;
    double angle = 0.0;
    plane_errors(scene, plane, height, angle);
    heights.push_back(std::abs(height));
    angles.push_back(angle);
  }
  for (auto* values : {&errors, &heights, &angles}) std::sort(values->begin(), values->end());
  std::cout << "scale error: median " << 100.0 * errors[50] << " %, 90th " << 100.0 * errors[90]
            << " %, worst " << 100.0 * errors.back() << " %\n"
            << "plane: height at the centre median " << heights[50] << " mm, 90th " << heights[90]
            << " mm; normal median " << angles[50] << " deg, 90th " << angles[90] << " deg\n";
  EXPECT_LT(errors[90], 0.005);
  EXPECT_LT(heights[90], 1.0);
  EXPECT_LT(angles[90], 2.5);
}

TEST_F(Scale, PairsAreDrawnWhenThereAreTooMany) {
  std::mt19937 random(1);
  const CardScene scene = make_card_scene(random, {.count = 600, .noise_px = 0.3});
  ASSERT_TRUE(estimate(scene).ok());
  const auto most = static_cast<int>(kMaxScalePairs);
  EXPECT_LE(estimate_.pairs, most);
  EXPECT_GT(estimate_.pairs, most / 2);
  EXPECT_NEAR(estimate_.mm_per_baseline, scene.baseline_mm, 0.005 * scene.baseline_mm);
}

TEST_F(Scale, RefusesFewPairsAndScatteredRatios) {
  std::mt19937 random(1);
  CardScene scene = make_card_scene(random, {.count = 30});
  ScaleParams params;
  params.min_distance_fraction = 1.1;  // only pairs along the diagonal
  EXPECT_EQ(estimate(scene, params).code(), StatusCode::scale_not_found);
  std::vector<std::uint8_t> none(30, 0);
  Random draw(1);
  EXPECT_EQ(estimate_scale(scene.tracks, none, size_.length_mm(), {}, draw, *memory_, estimate_).code(),
            StatusCode::scale_not_found);
  std::uniform_real_distribution<double> factor(0.5, 2.0);
  for (CardTrack& track : scene.tracks) track.point_in_first *= factor(random);
  EXPECT_EQ(estimate(scene).code(), StatusCode::scale_not_found);
  Plane plane;
  EXPECT_EQ(fit_plane(scene, plane).code(), StatusCode::table_not_found);
}

TEST_F(Scale, PlaneOfALineIsRefused) {
  std::mt19937 random(1);
  CardScene scene = make_card_scene(random, {.count = 30});
  ASSERT_TRUE(estimate(scene).ok());
  for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
    const double along = static_cast<double>(i);
    scene.tracks[i].point_in_first = Vec3(along, 0.5 * along, 600.0) / scene.baseline_mm;
  }
  Plane plane;
  EXPECT_EQ(fit_plane(scene, plane).code(), StatusCode::table_not_found);
}

TEST(CardTracks, AreClosedTriangles) {
  const std::vector<Match> first_second = {
      {0, 5, 0.0F}, {1, 4, 0.0F}, {2, 3, 0.0F}, {3, 2, 0.0F}, {4, 1, 0.0F}};
  const std::vector<Match> first_pattern = {{0, 7, 0.0F}, {1, 6, 0.0F}, {2, 5, 0.0F}, {4, 0, 0.0F}};
  const std::vector<Match> second_pattern = {{1, 0, 0.0F}, {2, 4, 0.0F}, {4, 2, 0.0F}, {5, 7, 0.0F}};
  const std::vector<std::uint8_t> in_cloud = {1, 1, 1, 1, 0};
  std::vector<Vec3> cloud(5);
  std::vector<Vec2> rays(8);
  std::vector<Vec2> pattern(8);
  for (std::size_t i = 0; i < 8; ++i) {
    rays[i] = Vec2(static_cast<double>(i), 0.0);
    pattern[i] = Vec2(0.0, static_cast<double>(i));
  }
  for (std::size_t i = 0; i < 5; ++i) cloud[i] = Vec3(0.0, 0.0, static_cast<double>(i));
  const CardObservations observations{first_second,   in_cloud, cloud, first_pattern,
                                      second_pattern, rays,     rays,  pattern};
  std::vector<CardTrack> storage(8);
  BoundedList<CardTrack> tracks(storage);
  build_card_tracks(observations, tracks);
  ASSERT_EQ(tracks.size(), 1U);  // 1-4 disagrees, 2-3 and 3-2 have one end only, 4-1 is not in the cloud
  EXPECT_EQ(tracks[0].pattern_mm.y(), 7.0);
  EXPECT_EQ(tracks[0].first.x(), 0.0);
  EXPECT_EQ(tracks[0].second.x(), 5.0);
  EXPECT_EQ(tracks[0].point_in_first.z(), 0.0);
}

}  // namespace
}  // namespace traygauge::paper
