// The equations of a patch's alignment: templates against OpenCV's warps, sums against all pixels one by one.
#include "core/tracking/alignment_equations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kEquationSide = 90;

cv::Mat1b smooth_picture(std::uint64_t seed) {
  cv::Mat1b picture = test::textured_picture(kEquationSide, kEquationSide, seed);
  cv::GaussianBlur(picture, picture, {}, 1.5);
  return picture;
}

// The map's columns lead from the second picture's pixels to the first's; OpenCV reads there bilinearly.
TEST(AlignmentEquations, TemplatesAreOpenCvsAffineWarps) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> near(-0.2, 0.2);
  const cv::Mat1b picture = smooth_picture(4);
  for (int round = 0; round < 20; ++round) {
    const Vec2 centre(44.0 + 10.0 * near(random), 45.0 + 10.0 * near(random));
    Eigen::Matrix2d map;
    map << 1.0 + near(random), near(random), near(random), 1.0 + near(random);
    AlignmentTemplate patch;
    ASSERT_TRUE(make_template(test::view_of(picture), centre, map, PatchMotion::affine, patch));
    cv::Mat1f at_x(kAlignmentSide, kAlignmentSide);
    cv::Mat1f at_y(kAlignmentSide, kAlignmentSide);
    for (int y = 0; y < kAlignmentSide; ++y) {
      for (int x = 0; x < kAlignmentSide; ++x) {
        const Vec2 at = centre + map * Vec2(x - kAlignmentReach, y - kAlignmentReach);
        at_x(y, x) = static_cast<float>(at.x());
        at_y(y, x) = static_cast<float>(at.y());
      }
    }
    cv::Mat1f exact;
    picture.convertTo(exact, CV_32F);
    cv::Mat1f truth;
    cv::remap(exact, truth, at_x, at_y, cv::INTER_LINEAR);
    for (int i = 0; i < kAlignmentPixels; ++i)
      ASSERT_NEAR(patch.values[i], truth(i / kAlignmentSide, i % kAlignmentSide), 1.5) << round;
  }
}

// The picture shifted by a known part of a pixel: one step finds most of the shift.
TEST(AlignmentEquations, AStepFindsAKnownShiftGainAndOffset) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> near(-0.3, 0.3);
  const cv::Mat1b picture = smooth_picture(6);
  cv::Mat1f exact;
  picture.convertTo(exact, CV_32F);
  for (int round = 0; round < 20; ++round) {
    const Vec2 shift(near(random), near(random));
    for (const PatchMotion motion : {PatchMotion::shift, PatchMotion::affine}) {
      AlignmentTemplate patch;
      ASSERT_TRUE(make_template(test::view_of(picture), Vec2(45.0, 45.0), Eigen::Matrix2d::Identity(), motion,
                                patch));
      cv::Mat1f window;
      const Vec2 corner = Vec2(45.0, 45.0) + shift - Vec2::Constant(kAlignmentReach);
      cv::warpAffine(exact, window, cv::Matx23d(1.0, 0.0, corner.x(), 0.0, 1.0, corner.y()),
                     {kAlignmentSide, kAlignmentSide}, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
      cv::Mat1f toned;
      window.convertTo(toned, CV_32F, 1.08, -6.0);
      alignas(16) std::array<float, kAlignmentPixels> values{};
      std::copy(toned.begin(), toned.end(), values.begin());
      const AlignmentResiduals residuals = gather_residuals(values.data(), motion, patch);
      EXPECT_GT(residuals.squares, 0.0);
      Vec2 found;
      double gain = 0.0;
      if (motion == PatchMotion::shift) {
        ShiftEquations::Vector step;
        ASSERT_TRUE(without_matrix(patch.equations).solve(0.0, step));
        found = step.head<2>();
        gain = step[kGainOfShift];
      } else {
        AlignmentEquations::Vector step;
        ASSERT_TRUE(patch.equations.solve(0.0, step));
        found = {step[kShiftX], step[kShiftY]};
        gain = step[kGain];
      }
      EXPECT_LT((found - shift).norm(), 0.06 + 0.2 * shift.norm());
      EXPECT_NEAR(gain, 0.08, 0.04);
    }
  }
}

TEST(AlignmentEquations, TemplatesMustLieInThePicture) {
  const cv::Mat1b picture = smooth_picture(6);
  AlignmentTemplate patch;
  const auto make = [&](double x, double y, double scale) {
    return make_template(test::view_of(picture), Vec2(x, y), scale * Eigen::Matrix2d::Identity(),
                         PatchMotion::shift, patch);
  };
  EXPECT_TRUE(make(45.0, 45.0, 1.0));
  EXPECT_FALSE(make(6.0, 45.0, 1.0));
  EXPECT_FALSE(make(45.0, 84.0, 1.0));
  EXPECT_FALSE(make(45.0, 45.0, 6.0));
  EXPECT_FALSE(make(std::nan(""), 45.0, 1.0));
}

}  // namespace
}  // namespace traygauge
