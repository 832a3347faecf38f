#include "core/quality/card_silhouette.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/arena.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/opencv_camera.hpp"

namespace traygauge {
namespace {

constexpr int kWidth = 1600;
constexpr int kHeight = 1200;
constexpr double kCardWidth_mm = 85.60;
constexpr double kCardHeight_mm = 53.98;
constexpr double kAspectRatio = kCardWidth_mm / kCardHeight_mm;

// The part of the card, from its left and upper edge, that is seen; OpenCV projects and fills it.
cv::Mat draw_card(cv::RNG& rng, double share_along, double share_across, double max_tilt_rad) {
  const cv::Vec3d turn(rng.uniform(-max_tilt_rad, max_tilt_rad), rng.uniform(-max_tilt_rad, max_tilt_rad),
                       rng.uniform(-3.0, 3.0));
  const cv::Vec3d place(rng.uniform(-120.0, 120.0), rng.uniform(-90.0, 90.0), rng.uniform(420.0, 580.0));
  cv::Matx33d roll;
  cv::Rodrigues(cv::Vec3d(0.0, 0.0, turn[2]), roll);
  cv::Matx33d tilt;
  cv::Rodrigues(cv::Vec3d(turn[0], turn[1], 0.0), tilt);
  const double right = share_along * kCardWidth_mm;
  const double bottom = share_across * kCardHeight_mm;
  const std::vector<cv::Point3d> corners = {{0, 0, 0}, {right, 0, 0}, {right, bottom, 0}, {0, bottom, 0}};
  const LensModel lens = test::phone_lens();
  cv::Vec3d rotation;
  cv::Rodrigues(tilt * roll, rotation);
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(corners, rotation, place, test::camera_matrix(lens.pinhole), test::distortion_of(lens),
                    pixels);
  std::vector<cv::Point> rounded;
  for (const cv::Point2d& pixel : pixels)
    rounded.emplace_back(cvRound(pixel.x * 256), cvRound(pixel.y * 256));
  cv::Mat labels = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  cv::fillConvexPoly(labels, rounded, cv::Scalar(kCardLabel), cv::LINE_8, 8);
  return labels;
}

class CardSilhouetteTest : public ::testing::Test {
 protected:
  CardSilhouette measure(const cv::Mat& labels) {
    const ImageView<const std::uint8_t> view{labels.data, labels.cols, labels.rows};
    return measure_card_silhouette(view, measure_regions(view).card, test::phone_lens(), *memory_);
  }
  double visible_fraction(const cv::Mat& labels) { return measure(labels).visible_fraction(kAspectRatio); }

  test::Allocated<CardSilhouetteWorkspace> memory_{kHeight};
};

TEST_F(CardSilhouetteTest, AWholeCardIsWhole) {
  for (int seed = 1; seed <= 200; ++seed) {
    cv::RNG rng(static_cast<std::uint64_t>(seed));
    const CardSilhouette outline = measure(draw_card(rng, 1.0, 1.0, 0.5));
    ASSERT_TRUE(outline.is_found) << "seed " << seed;
    EXPECT_NEAR(outline.aspect_ratio / kAspectRatio, 1.0, 0.05) << "seed " << seed;
    EXPECT_NEAR(outline.skew, 0.0, 0.06) << "seed " << seed;
    EXPECT_GT(outline.filled_fraction, 0.97) << "seed " << seed;
    EXPECT_GT(outline.visible_fraction(kAspectRatio), 0.90) << "seed " << seed;
    EXPECT_GT(outline.visible_fraction(1.0 / kAspectRatio), 0.90) << "upright cards, too; seed " << seed;
  }
}

TEST_F(CardSilhouetteTest, ACardCoveredFromOneSideIsNot) {
  for (int seed = 1; seed <= 60; ++seed) {
    for (const double share : {0.5, 0.65, 0.75}) {
      cv::RNG rng(static_cast<std::uint64_t>(seed));
      EXPECT_LT(visible_fraction(draw_card(rng, share, 1.0, 0.5)), 0.87) << share << " seed " << seed;
      EXPECT_LT(visible_fraction(draw_card(rng, 1.0, share, 0.5)), 0.82) << share << " seed " << seed;
    }
  }
}

// A corner, a strip through the middle, a hole.
TEST_F(CardSilhouetteTest, WhatLiesOnTheCardIsMissed) {
  cv::RNG rng(5);
  const cv::Mat whole = draw_card(rng, 1.0, 1.0, 0.3);
  std::vector<cv::Point> pixels;
  cv::findNonZero(whole, pixels);
  const double area = static_cast<double>(pixels.size());
  const cv::Rect box = cv::boundingRect(pixels);
  const cv::Point middle = (box.tl() + box.br()) / 2;
  const int radius = cvRound(std::sqrt(0.3 * area / CV_PI));
  cv::Mat hole = whole.clone();
  cv::circle(hole, middle, radius, cv::Scalar(0), cv::FILLED);
  EXPECT_NEAR(visible_fraction(hole), 0.7, 0.05);
  cv::Mat strip = whole.clone();
  cv::line(strip, {box.x, middle.y}, {box.x + box.width, middle.y}, cv::Scalar(0), 30);
  EXPECT_NEAR(visible_fraction(strip), cv::countNonZero(strip) / area, 0.05);
}

TEST_F(CardSilhouetteTest, LabelsWithoutACardOrShapeAreNotFound) {
  EXPECT_FALSE(measure(cv::Mat::zeros(kHeight, kWidth, CV_8U)).is_found);
  cv::Mat speck = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  speck.at<std::uint8_t>(600, 800) = kCardLabel;
  EXPECT_GE(visible_fraction(speck), 0.0);  // a square of one pixel
  cv::Mat line = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  line(cv::Rect(100, 100, 600, 1)) = kCardLabel;
  EXPECT_LT(visible_fraction(line), 0.2);
  EXPECT_EQ(CardSilhouette{}.visible_fraction(kAspectRatio), 0.0);
  const cv::Mat everything(kHeight, kWidth, CV_8U, cv::Scalar(kCardLabel));
  EXPECT_LT(visible_fraction(everything), 0.9);
}

TEST_F(CardSilhouetteTest, NoiseNeverHarms) {
  for (int seed = 1; seed <= 100; ++seed) {
    cv::RNG rng(static_cast<std::uint64_t>(seed));
    cv::Mat labels = cv::Mat::zeros(kHeight, kWidth, CV_8U);
    for (int i = 0; i < 1 + seed; ++i) {
      labels.at<std::uint8_t>(rng.uniform(0, kHeight), rng.uniform(0, kWidth)) = kCardLabel;
    }
    const double share = visible_fraction(labels);
    EXPECT_TRUE(share >= 0.0 && share <= 1.0) << "seed " << seed << ": " << share;
  }
}

}  // namespace
}  // namespace traygauge
