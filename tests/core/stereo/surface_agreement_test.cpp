// Two pictures of a plane with random grain, seen in closed form: the height at which it lies is found, and
// nothing is said of a plane without grain, of shine that moves with the eye, or of what is not bare.
#include "core/stereo/surface_agreement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>
#include <random>

#include "tests/core/stereo/grain_scene.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kBare = 7;
constexpr double kHalfSideMm = 60.0;

class SurfaceAgreements : public ::testing::Test {
 protected:
  void render(const test::GrainyPlane& plane) { scene_.render(plane); }

  AgreedHeight solve() const {
    const test::GrainScene::Seen seen(scene_);
    SurfaceAgreement agreement(seen.views[0], seen.views[1], kBare, Vec3::Zero(), SurfaceAgreementParams{});
    for (double y = -kHalfSideMm; y <= kHalfSideMm; y += 2.5) {
      for (double x = -kHalfSideMm; x <= kHalfSideMm; x += 2.5) agreement.add({x, y, 0.0});
    }
    return agreement.solve();
  }

  std::mt19937 random_{test::random_seed()};
  test::GrainScene scene_{random_, kBare};
  std::array<cv::Mat1b, 2>& labels_ = scene_.labels;
  std::array<cv::Mat1b, 2>& pictures_ = scene_.pictures;
};

TEST_F(SurfaceAgreements, FindTheHeight) {
  for (int round = 0; round < 10; ++round) {
    const double height_mm = std::uniform_real_distribution<double>(-4.5, 4.5)(random_);
    render({.height_mm = height_mm});
    const AgreedHeight found = solve();
    ASSERT_TRUE(found.is_known) << height_mm << " " << found.lead << " " << found.sigma_mm;
    // A parabola through three steps of 1 mm is off by up to a tenth of a step.
    EXPECT_NEAR(found.offset_mm, height_mm, 0.15);
    EXPECT_LT(found.sigma_mm, 0.15);
    EXPECT_GT(found.lead, 0.6);
  }
}

// Faint grain under as much noise: what one place does not tell, all together do.
TEST_F(SurfaceAgreements, FindItInFaintGrain) {
  render({.height_mm = 1.7, .contrast = 5.0, .noise = 3.0});
  const AgreedHeight found = solve();
  ASSERT_TRUE(found.is_known) << found.lead << " " << found.sigma_mm;
  EXPECT_NEAR(found.offset_mm, 1.7, 0.25);
}

TEST_F(SurfaceAgreements, SayNothingOfPlainGlaze) {
  render({.contrast = 0.0});
  EXPECT_FALSE(solve().is_known);
}

// It slid by more than its grain between the pictures: no height explains it.
TEST_F(SurfaceAgreements, SayNothingOfWhatMoved) {
  render({.shift_mm = 8.0});
  EXPECT_FALSE(solve().is_known);
}

TEST_F(SurfaceAgreements, SayNothingBeyondTheirReach) {
  for (const double height_mm : {-12.0, 12.0}) {
    render({.height_mm = height_mm});
    EXPECT_FALSE(solve().is_known) << height_mm;
  }
}

// Its parts lie at different heights, which their sigma tells.
TEST_F(SurfaceAgreements, AreUnsureOfATiltedPlane) {
  render({});
  const double level_sigma_mm = solve().sigma_mm;
  render({.tilt = 0.04});
  const AgreedHeight found = solve();
  EXPECT_TRUE(!found.is_known || found.sigma_mm > 2.0 * level_sigma_mm)
      << found.sigma_mm << " " << level_sigma_mm;
}

// What lies on it does not count: here everything but a corner too small for a verdict.
TEST_F(SurfaceAgreements, LeaveOutWhatIsNotBare) {
  render({.height_mm = 2.0});
  for (cv::Mat1b& labels : labels_) {
    labels.setTo(0);
    labels(cv::Rect(300, 220, 30, 30)).setTo(kBare);
  }
  EXPECT_FALSE(solve().is_known);
}

TEST_F(SurfaceAgreements, CountWhatIsBareAlone) {
  render({.height_mm = 2.0});
  // Half of the surface is covered by something whose grain lies at another height.
  const std::array<cv::Mat1b, 2> below = {pictures_[0].clone(), pictures_[1].clone()};
  render({.height_mm = -3.0});
  for (std::size_t i = 0; i < 2; ++i) {
    const cv::Rect bare(0, 0, 320, 480);
    below[i](bare).copyTo(pictures_[i](bare));
    labels_[i].setTo(0);
    labels_[i](bare).setTo(kBare);
  }
  const AgreedHeight found = solve();
  ASSERT_TRUE(found.is_known) << found.lead << " " << found.sigma_mm;
  EXPECT_NEAR(found.offset_mm, 2.0, 0.2);
}

}  // namespace
}  // namespace traygauge
