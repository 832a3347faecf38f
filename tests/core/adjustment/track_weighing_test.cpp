// How far tracks are believed: noise of known size, and wrong ones among them.
#include "core/adjustment/track_weighing.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/adjustment/bundle_scene.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

template <class Value>
test::BundleSceneOptions with_option(Value test::BundleSceneOptions::*option, Value value) {
  test::BundleSceneOptions options;
  options.*option = value;
  return options;
}

struct WeighedScene {
  test::BundleScene scene;
  BundleInput input;
  BundleParams params;
  test::Allocated<BundleWorkspace> space{std::size_t{2000}, std::size_t{500}};
  TrackWeighing weighing;

  explicit WeighedScene(std::uint64_t seed, const test::BundleSceneOptions& options)
      : scene(test::bundle_scene(seed, options)),
        input(scene.input()),
        weighing(input, input.tracks, params, *space) {}
  // The cameras are those of the scene; `spread` says how well they are known.
  void weigh(TrackTrust trust, double spread = 0.0) {
    BundleMatrix covariance = BundleMatrix::Zero();
    for (int i = 0; i < 12; ++i) covariance(i, i) = spread * (i % 6 < 3 ? 1e-8 : 1e-2);
    weighing.weigh(scene.camera_from_table, covariance, trust);
  }
  double share(bool TrackWeight::*use, bool is_background) {
    int used = 0;
    int all = 0;
    for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
      if ((scene.tracks[i].label == kBackgroundLabel) != is_background) continue;
      ++all;
      used += space->weights[i].*use ? 1 : 0;
    }
    return static_cast<double>(used) / all;
  }
};

// Tracks that are worse than they say are found to be so, up to what is still noise.
TEST(TrackWeighing, MeasuresHowMuchWorseTracksAreThanTheySay) {
  const std::uint32_t seed = test::random_seed();
  const auto factor = [&](double truth) {
    test::BundleSceneOptions options;
    options.track_error_factor = truth;
    options.table_tracks = options.dish_tracks = 700;
    WeighedScene scene(seed, options);
    scene.weigh(TrackTrust::lines);
    return scene.weighing.noise_factor();
  };
  EXPECT_NEAR(factor(1.0), 1.0, 0.2);
  EXPECT_NEAR(factor(2.0), 2.0, 0.4);
  EXPECT_NEAR(factor(2.5), 2.5, 0.45);
  EXPECT_EQ(factor(0.3), 1.0);
  EXPECT_EQ(factor(12.0), BundleParams{}.max_noise_factor);
}

TEST(TrackWeighing, BelievesAllThenDishesThenThoseNearTheirLines) {
  WeighedScene scene(test::random_seed(), with_option(&test::BundleSceneOptions::outlier_fraction, 0.25));
  scene.weigh(TrackTrust::all);
  EXPECT_EQ(scene.share(&TrackWeight::uses_line, true), 1.0);
  EXPECT_EQ(scene.share(&TrackWeight::uses_line, false), 1.0);
  EXPECT_EQ(scene.share(&TrackWeight::uses_table, true), 0.0);
  scene.weigh(TrackTrust::dishes);
  EXPECT_EQ(scene.share(&TrackWeight::uses_line, true), 0.0);
  EXPECT_EQ(scene.share(&TrackWeight::uses_line, false), 1.0);
  scene.weigh(TrackTrust::lines);
  // Wrong ones lie anywhere within tens of pixels, near their lines by chance alone.
  EXPECT_NEAR(scene.share(&TrackWeight::uses_line, true), 0.75, 0.13);
  EXPECT_NEAR(scene.share(&TrackWeight::uses_line, false), 0.75, 0.13);
  EXPECT_TRUE(scene.weighing.has_enough_on_dishes());
}

TEST(TrackWeighing, TakesTheTableForWhatIsFlatAndBackground) {
  WeighedScene scene(test::random_seed(), with_option(&test::BundleSceneOptions::raised_fraction, 0.3));
  scene.weigh(TrackTrust::consensus);
  EXPECT_NEAR(scene.share(&TrackWeight::uses_table, true), 0.7, 0.14);  // some are hardly raised
  EXPECT_EQ(scene.share(&TrackWeight::uses_table, false), 0.0);
  // Only once it was found does the table count.
  scene.weigh(TrackTrust::table);
  EXPECT_EQ(scene.share(&TrackWeight::uses_table, true), 0.0);
  scene.weigh(TrackTrust::consensus);
  scene.weighing.find_table_tracks(scene.scene.camera_from_table, BundleMatrix::Zero());
  ASSERT_TRUE(scene.weighing.is_table_found());
  scene.weigh(TrackTrust::table);
  EXPECT_NEAR(scene.share(&TrackWeight::uses_table, true), 0.7, 0.14);
  scene.weighing.drop_table();
  scene.weigh(TrackTrust::table);
  EXPECT_EQ(scene.share(&TrackWeight::uses_table, true), 0.0);
}

// The less is known of the cameras, the more may be right.
TEST(TrackWeighing, BelievesMoreWhileTheCamerasAreUnsure) {
  WeighedScene scene(test::random_seed(), with_option(&test::BundleSceneOptions::outlier_fraction, 0.4));
  scene.weigh(TrackTrust::lines);
  const double sure = scene.share(&TrackWeight::uses_line, true);
  const double scale = scene.space->weights[0].line_squared_scale;
  scene.weigh(TrackTrust::lines, 100.0);
  EXPECT_GT(scene.space->weights[0].line_squared_scale, 2.0 * scale);
  EXPECT_GT(scene.share(&TrackWeight::uses_line, true), sure + 0.05);
}

TEST(TrackWeighing, LeavesOutTheCardAndTooFewTracksOnDishes) {
  WeighedScene scene(test::random_seed(),
                     with_option(&test::BundleSceneOptions::dish_tracks, kMinTracks - 1));
  EXPECT_FALSE(scene.weighing.has_enough_on_dishes());
  for (PointTrack& track : scene.scene.tracks) track.label = kCardLabel;
  scene.weigh(TrackTrust::all);
  for (std::size_t i = 0; i < scene.scene.tracks.size(); ++i) {
    EXPECT_FALSE(scene.space->weights[i].uses_line);
    EXPECT_FALSE(scene.space->weights[i].uses_table);
  }
}

}  // namespace
}  // namespace traygauge
