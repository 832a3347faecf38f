// Two pictures of a plane with random grain, seen in closed form: the height at which it lies is found, and
// nothing is said of a plane without grain, of shine that moves with the eye, or of what is not bare.
#include "core/stereo/surface_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/core/stereo/synthetic_scene.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kBare = 7;
constexpr double kHalfSideMm = 60.0;

struct BareScene {
  double height_mm = 0.0;  // of the plane over where it is described to lie
  double tilt = 0.0;       // mm of height a mm along x
  double contrast = 20.0;  // of its grain, grey values
  double noise = 2.0;      // of the pictures
  double shift_mm = 0.0;   // of the grain, in the second picture, across the line between the cameras
};

class SurfaceAgreements : public ::testing::Test {
 protected:
  SurfaceAgreements() {
    std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
    const double azimuth = angle(random_);
    views_ = {test::look_at_origin(450.0, 0.15, azimuth), test::look_at_origin(450.0, 0.5, azimuth)};
    grain_ = cv::Mat1f(256, 256);
    cv::randn(grain_, 0.0, 1.0);
    // Grains of 2 mm; the texture repeats every 256 mm.
    cv::GaussianBlur(grain_, grain_, {}, 0.8, 0.8, cv::BORDER_REFLECT_101);
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(grain_, mean, deviation);
    grain_ /= deviation[0];
    for (cv::Mat1b& labels : labels_) labels = cv::Mat1b(views_[0].height, views_[0].width, kBare);
  }

  double grain_at(const Vec2& place) const {
    const double x = place.x() + 128.0;
    const double y = place.y() + 128.0;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    if (column < 0 || row < 0 || column + 1 >= grain_.cols || row + 1 >= grain_.rows) return 0.0;
    const double u = x - column;
    const double v = y - row;
    return (1.0 - v) * ((1.0 - u) * grain_(row, column) + u * grain_(row, column + 1)) +
           v * ((1.0 - u) * grain_(row + 1, column) + u * grain_(row + 1, column + 1));
  }

  void render(const BareScene& scene) {
    std::normal_distribution<double> noise(0.0, scene.noise);
    const Vec3 line = (views_[1].centre() - views_[0].centre()).normalized();
    const Vec2 across(-line.y(), line.x());
    for (std::size_t i = 0; i < 2; ++i) {
      const test::SyntheticView& view = views_[i];
      pictures_[i] = cv::Mat1b(view.height, view.width);
      for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
          const Vec3 ray = view.world_ray(x, y);
          const Vec3 eye = view.centre();
          // eye.z + t ray.z = height + tilt (eye.x + t ray.x)
          const double t =
              (scene.height_mm + scene.tilt * eye.x() - eye.z()) / (ray.z() - scene.tilt * ray.x());
          Vec2 place = (eye + t * ray).head<2>();
          if (i == 1) place += scene.shift_mm * across;
          pictures_[i](y, x) =
              cv::saturate_cast<std::uint8_t>(130.0 + scene.contrast * grain_at(place) + noise(random_));
        }
      }
    }
  }

  AgreedHeight solve() const {
    const SurfaceAgreementParams params;
    std::array<GrayPyramid, 2> pyramids;
    std::array<LensModel, 2> lenses;
    std::array<PyramidWorkspace, 2> workspaces;
    std::array<std::vector<std::uint8_t>, 4> storage;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t level = 0; level < 2; ++level) {
        storage[2 * i + level].resize(static_cast<std::size_t>(views_[i].width) *
                                      static_cast<std::size_t>(views_[i].height));
        workspaces[i].storage[level] = storage[2 * i + level];
      }
      pyramids[i] = build_pyramid({pictures_[i].data, pictures_[i].cols, pictures_[i].rows}, workspaces[i]);
      lenses[i].width = views_[i].width;
      lenses[i].height = views_[i].height;
      lenses[i].pinhole = views_[i].camera;
    }
    const auto view = [&](std::size_t i) {
      return SurfaceView{pyramids[i],
                         lenses[i],
                         {labels_[i].data, labels_[i].cols, labels_[i].rows},
                         views_[i].camera_from_world};
    };
    const SurfaceView first = view(0);
    const SurfaceView second = view(1);
    SurfaceAgreement agreement(first, second, kBare, Vec3::Zero(), params);
    for (double y = -kHalfSideMm; y <= kHalfSideMm; y += 2.5) {
      for (double x = -kHalfSideMm; x <= kHalfSideMm; x += 2.5) agreement.add({x, y, 0.0});
    }
    return agreement.solve();
  }

  std::mt19937 random_{test::random_seed()};
  std::array<test::SyntheticView, 2> views_;
  std::array<cv::Mat1b, 2> labels_;
  std::array<cv::Mat1b, 2> pictures_;
  cv::Mat1f grain_;
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
