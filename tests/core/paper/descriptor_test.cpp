#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <string>

#include "core/base/random.hpp"
#include "core/features/descriptor_block.hpp"
#include "core/image/gaussian.hpp"
#include "core/paper/features/angle.hpp"
#include "tests/core/paper/surf_on_picture.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge::paper {
namespace {

using test::PictureFeatures;
using test::run_surf;
using test::textured_picture;

TEST(Angle, EqualsAtan2) {
  cv::RNG rng(1);
  for (int i = 0; i < 10000; ++i) {
    const auto x = static_cast<float>(rng.gaussian(1.0));
    const auto y = static_cast<float>(rng.gaussian(1.0));
    ASSERT_NEAR(angle_of(x, y), std::atan2(y, x), 2e-5F);
  }
  EXPECT_EQ(angle_of(0.0F, 0.0F), 0.0F);
  EXPECT_NEAR(angle_of(-1.0F, 0.0F), std::numbers::pi_v<float>, 1e-6F);
}

TEST(Gaussian, EqualsExp) {
  for (double x = 0.0; x <= 40.0; x += 0.37) EXPECT_NEAR(exp_of_minus(x) / std::exp(-x), 1.0, 1e-11);
}

double length(const Descriptor& descriptor) {
  double square = 0.0;
  for (const float value : descriptor) square += static_cast<double>(value) * static_cast<double>(value);
  return std::sqrt(square);
}

double distance(const Descriptor& a, const Descriptor& b) {
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(static_cast<double>(a[i] - b[i]), 2.0);
  return std::sqrt(square);
}

TEST(Descriptor, HasUnitLengthAndAnAngle) {
  const PictureFeatures found = run_surf(textured_picture(300, 250, 2));
  ASSERT_GT(found.keypoints.size(), 100U);
  for (std::size_t i = 0; i < found.keypoints.size(); ++i) {
    EXPECT_NEAR(length(found.descriptors[i]), 1.0, 1e-5);
    EXPECT_NE(found.keypoints[i].angle_rad, 0.0F);
  }
}

TEST(Descriptor, DoesNotSeeGainAndOffset) {
  const cv::Mat picture = textured_picture(300, 250, 3) / 2;
  const cv::Mat brighter = 2 * picture + 5;
  std::vector<Keypoint> keypoints = run_surf(picture).keypoints;
  std::vector<Keypoint> again = keypoints;
  std::vector<Descriptor> first(keypoints.size());
  std::vector<Descriptor> second(keypoints.size());
  describe_surf(test::Integral(picture).view(), keypoints, first);
  describe_surf(test::Integral(brighter).view(), again, second);
  // At the picture's edge the windows are cut off, and there the offset counts.
  std::size_t compared = 0;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const double reach = 16.0 * static_cast<double>(keypoints[i].scale_px) + 4.0;
    const Vec2& pixel = keypoints[i].pixel;
    if (pixel.minCoeff() < reach || pixel.x() > 300.0 - reach || pixel.y() > 250.0 - reach) continue;
    ++compared;
    EXPECT_LT(distance(first[i], second[i]), 1e-3);
    EXPECT_NEAR(keypoints[i].angle_rad, again[i].angle_rad, 1e-3F);
  }
  EXPECT_GT(compared, 50U);
}

TEST(Descriptor, IsZeroOnUniformGround) {
  std::vector<Keypoint> keypoints(1);
  keypoints[0].pixel = {60.0, 60.0};
  keypoints[0].scale_px = 2.0F;
  std::vector<Descriptor> descriptors(1);
  describe_surf(test::Integral(cv::Mat(120, 120, CV_8U, cv::Scalar(90))).view(), keypoints, descriptors);
  EXPECT_EQ(descriptors[0], Descriptor{});
  EXPECT_EQ(keypoints[0].angle_rad, 0.0F);
}

// A step edge, bright on the side of `angle`: its gradient, and so the orientation, is known.
TEST(Orientation, FollowsTheGradient) {
  for (int degrees = -170; degrees <= 180; degrees += 10) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec2 normal(std::cos(angle), std::sin(angle));
    cv::Mat picture(161, 161, CV_8U);
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) {
        const double along = normal.dot(Vec2(x - 80.0, y - 80.0));
        picture.at<std::uint8_t>(y, x) =
            cv::saturate_cast<std::uint8_t>(128.0 + 100.0 * std::tanh(along / 4.0));
      }
    }
    std::vector<Keypoint> keypoints(1);
    keypoints[0].pixel = {80.0, 80.0};
    keypoints[0].scale_px = 4.0F;
    std::vector<Descriptor> descriptors(1);
    describe_surf(test::Integral(picture).view(), keypoints, descriptors);
    const double error =
        std::remainder(static_cast<double>(keypoints[0].angle_rad) - angle, 2.0 * std::numbers::pi);
    EXPECT_LT(std::abs(error), 0.035) << degrees;
  }
}

// Turned by a quarter the pixels are the same, and so must the oriented descriptors be.
TEST(Descriptor, TurnsWithThePicture) {
  const cv::Mat picture = textured_picture(300, 300, 4);
  cv::Mat turned;
  cv::rotate(picture, turned, cv::ROTATE_90_CLOCKWISE);  // (x, y) → (299 − y, x)
  const PictureFeatures before = run_surf(picture, {.first_step_px = 1});
  std::vector<Keypoint> keypoints = before.keypoints;
  for (Keypoint& keypoint : keypoints) keypoint.pixel = {299.0 - keypoint.pixel.y(), keypoint.pixel.x()};
  std::vector<Descriptor> after(keypoints.size());
  describe_surf(test::Integral(turned).view(), keypoints, after);
  std::size_t close = 0;
  for (std::size_t i = 0; i < keypoints.size(); ++i) close += distance(before.descriptors[i], after[i]) < 0.1;
  EXPECT_GT(static_cast<double>(close), 0.95 * static_cast<double>(keypoints.size()));
}

TEST(DescriptorBlock, CountsTheBitsThatDiffer) {
  constexpr std::uint64_t kSeed = 31;
  Random random(kSeed);
  const auto draw = [&] {
    BinaryDescriptor descriptor{};
    const std::uint32_t share = random.below(33);  // of set bits, in 32nds: all, none, and between
    for (std::uint64_t& word : descriptor) {
      for (int bit = 0; bit < 64; ++bit) word = word << 1U | (random.below(32) < share ? 1U : 0U);
    }
    return descriptor;
  };
  for (int round = 0; round < 300; ++round) {
    std::array<BinaryDescriptor, DescriptorBlock::kSide> others;
    DescriptorBlock block;
    for (std::size_t i = 0; i < others.size(); ++i) {
      others[i] = draw();
      block.set(i, others[i]);
    }
    const BinaryDescriptor descriptor = draw();
    const DescriptorBlock::Distances distances = block.distances(DescriptorBlock::spread(descriptor));
    for (std::size_t i = 0; i < others.size(); ++i) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + " round " + std::to_string(round));
      std::array<int, 4> differ{};
      for (std::size_t word = 0; word < 4; ++word)
        differ[word] = std::popcount(descriptor[word] ^ others[i][word]);
      ASSERT_EQ(distances[i], differ[0] + differ[1]);
      ASSERT_EQ(hamming_distance(descriptor, others[i], 2, 4), differ[2] + differ[3]);
      ASSERT_EQ(hamming_distance(descriptor, others[i]), differ[0] + differ[1] + differ[2] + differ[3]);
    }
  }
}

}  // namespace
}  // namespace traygauge::paper
