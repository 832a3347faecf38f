#include "core/quality/item_pixels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::view_of;

constexpr int kPictureSide = 320;
constexpr std::uint8_t kItem = 7;

ItemPixels measure(const cv::Mat& gray, const cv::Mat& labels) {
  ItemPixelTable items;
  measure_item_pixels(view_of(gray), view_of(labels), measure_regions(view_of(labels)).dish, {}, items);
  return items[kItem];
}

cv::Mat disc_labels() {
  cv::Mat labels = cv::Mat::zeros(kPictureSide, kPictureSide, CV_8U);
  cv::circle(labels, {kPictureSide / 2, kPictureSide / 2}, 150, cv::Scalar(1), cv::FILLED);
  cv::circle(labels, {kPictureSide / 2, kPictureSide / 2}, 110, cv::Scalar(kItem), cv::FILLED);
  return labels;
}

cv::Mat plain(double value) {
  return {kPictureSide, kPictureSide, CV_8U, cv::Scalar(value)};
}

cv::Mat noise(std::uint64_t seed, double sigma, double correlation_px) {
  cv::Mat values(kPictureSide, kPictureSide, CV_32F);
  cv::RNG(seed).fill(values, cv::RNG::NORMAL, 0.0, 1.0);
  if (correlation_px > 0.0) cv::GaussianBlur(values, values, {0, 0}, correlation_px);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(values, mean, deviation);
  return (values - mean[0]) * (sigma / deviation[0]);
}

cv::Mat with(const cv::Mat& picture, const cv::Mat& values) {
  cv::Mat sum;
  cv::add(picture, values, sum, cv::noArray(), CV_8U);
  return sum;
}

TEST(ItemPixels, CountsWhatOpenCvCounts) {
  cv::Mat gray(kPictureSide, kPictureSide, CV_8U);
  cv::RNG(9).fill(gray, cv::RNG::UNIFORM, 0, 256);
  const cv::Mat labels = disc_labels();
  const ItemPixels item = measure(gray, labels);
  const cv::Mat of_item = labels == kItem;
  const cv::Mat clipped = (gray <= 2) | (gray >= 252);
  EXPECT_EQ(item.pixels, static_cast<std::uint32_t>(cv::countNonZero(of_item)));
  EXPECT_EQ(item.clipped, static_cast<std::uint32_t>(cv::countNonZero(of_item & clipped)));
}

TEST(ItemPixels, TextureIsToldFromNoiseShadeAndNothing) {
  const cv::Mat labels = disc_labels();
  cv::Mat shade(kPictureSide, kPictureSide, CV_8U);
  for (int y = 0; y < kPictureSide; ++y) {
    for (int x = 0; x < kPictureSide; ++x)
      shade.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(40 + (x + y) / 4);
  }
  EXPECT_EQ(measure(plain(120), labels).textured_fraction(), 0.0);
  EXPECT_EQ(measure(shade, labels).textured_fraction(), 0.0);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const double sigma : {2.0, 5.0, 15.0, 30.0}) {
      EXPECT_LT(measure(with(plain(120), noise(seed, sigma, 0.0)), labels).textured_fraction(), 0.05)
          << "noise of " << sigma << ", seed " << seed;
    }
    const cv::Mat texture = with(plain(120), noise(seed, 6.0, 3.0));
    EXPECT_GT(measure(texture, labels).textured_fraction(), 0.95) << "seed " << seed;
    EXPECT_GT(measure(with(texture, noise(seed + 50, 3.0, 0.0)), labels).textured_fraction(), 0.9)
        << "seed " << seed;
    EXPECT_LT(measure(with(texture, noise(seed + 50, 40.0, 0.0)), labels).textured_fraction(), 0.5)
        << "seed " << seed;
  }
}

TEST(ItemPixels, HalfOfAnItemIsHalf) {
  const cv::Mat labels = disc_labels();
  cv::Mat half = with(plain(120), noise(1, 8.0, 3.0));
  half(cv::Rect(0, 0, kPictureSide / 2, kPictureSide)) = 120;
  EXPECT_NEAR(measure(half, labels).textured_fraction(), 0.5, 0.07);
}

TEST(ItemPixels, SmallAndAbsentItemsAreNotJudged) {
  cv::Mat labels = cv::Mat::zeros(kPictureSide, kPictureSide, CV_8U);
  EXPECT_EQ(measure(plain(120), labels).textured_fraction(), 1.0);
  EXPECT_EQ(measure(plain(120), labels).clipped_fraction(), 0.0);
  labels(cv::Rect(101, 101, 15, 15)) = kItem;
  const ItemPixels item = measure(plain(255), labels);
  EXPECT_EQ(item.blocks, 0U);
  EXPECT_EQ(item.clipped_fraction(), 1.0);
}

// A spot on the lens stays where it is, while what moves with the scene hides another part in each picture.
TEST(ItemPixels, CountsBlocksThatAreBlankAtTheSamePlaceOfBothPictures) {
  const cv::Mat labels = disc_labels();
  constexpr int kSpotPx = 90;
  const auto blank_with_spots = [&](cv::Point first, cv::Point second) {
    std::array<cv::Mat, 2> grays = {with(plain(120.0), noise(3, 12.0, 1.5)),
                                    with(plain(120.0), noise(4, 12.0, 1.5))};
    const std::array<cv::Point, 2> middles = {first, second};
    for (std::size_t i = 0; i < 2; ++i)
      cv::circle(grays[i], middles[i], kSpotPx / 2, cv::Scalar(30), cv::FILLED);
    BlankBlockTable blank;
    count_blank_blocks({view_of(grays[0]), view_of(grays[1])}, {view_of(labels), view_of(labels)},
                       measure_regions(view_of(labels)).dish, {}, blank);
    return blank[kItem];
  };
  // Of 16 × 16 px, between those wholly within and those that a circle touches.
  const std::uint32_t within = blank_with_spots({160, 160}, {160, 160});
  EXPECT_GE(within, 10U);
  EXPECT_LE(within, 32U);
  EXPECT_EQ(blank_with_spots({110, 160}, {220, 160}), 0U);
}

}  // namespace
}  // namespace traygauge
