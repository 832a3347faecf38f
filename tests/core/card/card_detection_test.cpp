#include "core/card/card_detection.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/card/card_evidence.hpp"
#include "core/card/card_pose.hpp"
#include "tests/core/card/synthetic_card.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

constexpr CardModel kModels[] = {CardModel::homography, CardModel::absolute_pose};

class FindCard : public testing::Test {
 protected:
  Status find(const std::vector<CardTrack>& tracks, const CardParams& params = {}, unsigned seed = 1) {
    Random random(seed);
    return find_card(tracks, size_, params, random, *memory_, fit_);
  }
  test::Allocated<CardWorkspace> memory_{1500};
  CardModelSize size_;
  CardFit fit_;
};

TEST_F(FindCard, ExactCardsAreFoundWhole) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const CardScene scene = make_card_scene(random, {.count = 40});
    for (const CardModel model : kModels) {
      CardParams params;
      params.detection.model = model;
      ASSERT_TRUE(find(scene.tracks, params, seed).ok());
      EXPECT_EQ(fit_.inlier_count, 40);
      EXPECT_LT(fit_.rms_mm, 1e-6);
      Pose pose;
      ASSERT_TRUE(pose_from_homography(fit_.pattern_from_first, pose));
      EXPECT_LT((pose.translation - scene.first_from_card.translation).norm(), 1e-3);
    }
  }
}

TEST_F(FindCard, HalfOfTheMatchesMayBeWrong) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const CardScene scene = make_card_scene(random, {.count = 80, .noise_px = 0.3, .outlier_fraction = 0.5});
    for (const CardModel model : kModels) {
      CardParams params;
      params.detection.model = model;
      ASSERT_TRUE(find(scene.tracks, params, seed).ok());
      int missed = 0;
      int wrong = 0;
      for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
        missed += scene.is_true[i] != 0 && fit_.inliers[i] == 0 ? 1 : 0;
        wrong += scene.is_true[i] == 0 && fit_.inliers[i] != 0 ? 1 : 0;
      }
      EXPECT_EQ(missed, 0);
      EXPECT_LE(wrong, 4);  // an outlier falls within 2.6 mm of its place once in 200
      EXPECT_LT(fit_.log10_false_alarms, -10.0);
    }
  }
}

TEST_F(FindCard, RandomMatchesAreNoCard) {
  int most = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    std::mt19937 random(seed);
    const auto tracks = random_tracks(random, 8 + static_cast<int>(random() % 150));
    CardParams params;
    params.detection.max_iterations = 500;  // keeps the test short; chances per iteration stay the same
    EXPECT_EQ(find(tracks, params, seed).code(), StatusCode::card_not_found) << "seed " << seed;
    most = std::max(most, fit_.inlier_count);
  }
  std::cout << "most inliers among random matches: " << most << "\n";
}

// With weak demands on number, spread and view, only the argument against chance stands between random
// matches and a card.
TEST_F(FindCard, ChanceAloneIsRefused) {
  int accepted_without = 0;
  for (unsigned seed = 1; seed <= 500; ++seed) {
    std::mt19937 random(seed);
    const auto tracks = random_tracks(random, 50 + static_cast<int>(random() % 150));
    CardParams params;
    params.detection.min_tracks = 6;
    params.detection.min_spread_fraction = 0.0;
    params.detection.max_skew = 1.0;
    params.detection.min_distance_mm = 0.0;
    params.detection.inlier_fraction = 0.05;
    params.detection.max_iterations = 500;
    EXPECT_EQ(find(tracks, params, seed).code(), StatusCode::card_not_found) << "seed " << seed;
    params.detection.max_false_alarms = 1e30;
    accepted_without += find(tracks, params, seed).ok() ? 1 : 0;
  }
  EXPECT_GT(accepted_without, 10) << "the argument was put to the test";
  std::cout << accepted_without << " of 500 would pass without it\n";
}

// The default demands, but the rays crowd where a printed napkin may lie and the inlier distance is generous.
TEST_F(FindCard, RandomMatchesInASmallPatchAreNoCard) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    std::mt19937 random(seed);
    auto tracks = random_tracks(random, 20 + static_cast<int>(random() % 60));
    for (CardTrack& track : tracks) track.first *= 0.2;
    CardParams params;
    params.detection.inlier_fraction = 0.05;
    params.detection.max_iterations = 500;
    EXPECT_EQ(find(tracks, params, seed).code(), StatusCode::card_not_found) << "seed " << seed;
  }
}

TEST_F(FindCard, MirroredCardsAreRefused) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    CardScene scene = make_card_scene(random, {.count = 40});
    for (CardTrack& track : scene.tracks) track.pattern_mm.x() = size_.width_mm - track.pattern_mm.x();
    EXPECT_EQ(find(scene.tracks, {}, seed).code(), StatusCode::card_not_found) << "seed " << seed;
  }
}

TEST_F(FindCard, ImpossibleViewsAreRefused) {
  std::mt19937 random(1);
  CardScene stretched = make_card_scene(random, {.count = 40});
  for (CardTrack& track : stretched.tracks) track.pattern_mm.x() *= 0.5;  // not a card of this size
  EXPECT_EQ(find(stretched.tracks).code(), StatusCode::card_not_found);
  const CardScene far = make_card_scene(random, {.count = 40, .distance_mm = 5000.0});
  EXPECT_EQ(find(far.tracks).code(), StatusCode::card_not_found);
  CardParams generous;
  generous.detection.max_distance_mm = 1e4;
  EXPECT_TRUE(find(far.tracks, generous).ok());
}

TEST_F(FindCard, DegenerateTracksAreRefused) {
  std::mt19937 random(2);
  const CardScene scene = make_card_scene(random, {.count = 40});
  std::vector<CardTrack> line;
  for (int i = 0; i < 40; ++i) {
    CardTrack track;
    track.pattern_mm = Vec2(2.0 * i, 10.0 + i);
    track.first = project(scene.first_from_card, track.pattern_mm);
    line.push_back(track);
  }
  EXPECT_EQ(find(line).code(), StatusCode::card_not_found);
  std::normal_distribution<double> gauss(0.0, 0.5);
  for (CardTrack& track : line) {  // a line of print, half a millimetre wide
    track.pattern_mm += Vec2(gauss(random), gauss(random));
    track.first = project(scene.first_from_card, track.pattern_mm);
  }
  EXPECT_EQ(find(line).code(), StatusCode::card_not_found);
  EXPECT_EQ(find(std::vector<CardTrack>(40, scene.tracks[0])).code(), StatusCode::card_not_found);
  EXPECT_EQ(find({}).code(), StatusCode::card_not_found);
  EXPECT_EQ(find({scene.tracks.begin(), scene.tracks.begin() + 7}).code(), StatusCode::card_not_found);
  EXPECT_TRUE(find(scene.tracks).ok());
}

TEST_F(FindCard, SameSeedSameBits) {
  std::mt19937 random(4);
  const CardScene scene = make_card_scene(random, {.count = 60, .noise_px = 0.5, .outlier_fraction = 0.4});
  ASSERT_TRUE(find(scene.tracks, {}, 7).ok());
  const CardFit once = fit_;
  ASSERT_TRUE(find(scene.tracks, {}, 7).ok());
  EXPECT_EQ(once.pattern_from_first, fit_.pattern_from_first);
  EXPECT_EQ(once.iterations, fit_.iterations);
}

// Closed form for area-driven chance: n = 8 of 8 in 8 places.
TEST(CardEvidence, FalseAlarmsByHand) {
  const CardModelSize size;
  std::vector<CardTrack> tracks(8);
  for (std::size_t i = 0; i < 8; ++i) {
    tracks[i].pattern_mm =
        Vec2(10.0 + 20.0 * static_cast<double>(i % 4), 10.0 + 30.0 * static_cast<double>(i / 4));
  }
  const std::vector<std::uint8_t> all(8, 1);
  const double chance = std::numbers::pi * 2.5 * 2.5 / (85.6 * 53.98);
  const double expected = std::log10(4.0 * 1.0 * 70.0 * std::pow(chance, 4));
  EXPECT_NEAR(log10_false_alarms(tracks, all, 2.5, size), expected, 1e-12);
  EXPECT_NEAR(least_spread_mm(tracks, all), 15.0, 1e-12);
}

}  // namespace
}  // namespace traygauge
