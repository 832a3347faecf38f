// A patch over a plane with grain correlates at the plane's height, and nowhere else; nothing correlates
// without grain, or under a label.
#include "core/stereo/level_patch.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>

#include "tests/core/stereo/grain_scene.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kFreeLabel = 3;

class LevelPatches : public ::testing::Test {
 protected:
  // Everywhere around the scene's middle.
  double mean_correlation(double height_mm) const {
    const test::GrainScene::Seen seen(scene_);
    const LevelPatch patch(seen.views[0], seen.views[1], kFreeLabel, Vec3::Zero(), LevelPatchParams{});
    double sum = 0.0;
    int count = 0;
    for (double y = -40.0; y <= 40.0; y += 20.0) {
      for (double x = -40.0; x <= 40.0; x += 20.0) {
        sum += patch.correlation({x, y, height_mm});
        ++count;
      }
    }
    return sum / count;
  }

  std::mt19937 random_{test::random_seed()};
  test::GrainScene scene_{random_, kFreeLabel};
};

TEST_F(LevelPatches, CorrelateAtTheirHeightAlone) {
  for (int round = 0; round < 5; ++round) {
    const double height_mm = std::uniform_real_distribution<double>(0.0, 50.0)(random_);
    scene_.render({.height_mm = height_mm});
    EXPECT_GT(mean_correlation(height_mm), 0.9) << height_mm;
    for (const double off_mm : {-20.0, -10.0, 10.0, 20.0})
      EXPECT_LT(mean_correlation(height_mm + off_mm), 0.3) << height_mm << " " << off_mm;
  }
}

TEST_F(LevelPatches, SayNothingOfAPlainPlane) {
  scene_.render({.contrast = 0.0});
  EXPECT_EQ(mean_correlation(0.0), -1.0);
}

TEST_F(LevelPatches, SayNothingOfWhatIsLabelledInEitherPicture) {
  scene_.render({.height_mm = 10.0});
  for (cv::Mat1b& labels : scene_.labels) {
    labels.setTo(kFreeLabel + 1);
    EXPECT_EQ(mean_correlation(10.0), -1.0);
    labels.setTo(kFreeLabel);
  }
}

}  // namespace
}  // namespace traygauge
