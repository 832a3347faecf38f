#include "core/quality/region_colours.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace traygauge {
namespace {

constexpr int kColumns = 300;
constexpr int kRows = 200;

double to_light(double code) {
  const double v = code / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double to_code(double light) {
  return 255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
}

cv::Mat3b random_picture(std::uint64_t seed) {
  cv::Mat3b picture(kRows, kColumns);
  cv::RNG(seed).fill(picture, cv::RNG::UNIFORM, 20, 160);
  return picture;
}

// The same picture in other light, blue, green and red apart.
cv::Mat3b relit(const cv::Mat3b& picture, const cv::Vec3d& gains) {
  cv::Mat3b result(picture.size());
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        result(y, x)[c] = cv::saturate_cast<std::uint8_t>(to_code(gains[c] * to_light(picture(y, x)[c])));
      }
    }
  }
  return result;
}

// Five stripes: background, dish, two items, card.
cv::Mat1b stripes() {
  cv::Mat1b labels(kRows, kColumns);
  constexpr std::uint8_t kLabels[] = {0, 1, 2, 3, 255};
  for (int i = 0; i < 5; ++i) labels(cv::Rect(60 * i, 0, 60, kRows)) = kLabels[i];
  return labels;
}

RegionColours measure(const cv::Mat3b& picture, PixelFormat format = PixelFormat::bgr8) {
  const cv::Mat1b labels = stripes();
  const FrameView frame{picture.data, kColumns, kRows, static_cast<std::ptrdiff_t>(picture.step[0]), format};
  RegionColours colours;
  measure_region_colours(frame, {labels.data, kColumns, kRows}, {}, colours);
  return colours;
}

TEST(RegionColours, MeansAreThoseOfLinearLight) {
  const cv::Mat3b picture = random_picture(1);
  const cv::Mat1b labels = stripes();
  cv::Vec3d sum;
  int count = 0;
  for (int y = 0; y < kRows; y += 2) {
    for (int x = 0; x < kColumns; x += 2) {
      if (labels(y, x) != 2) continue;
      for (int c = 0; c < 3; ++c) sum[c] += to_light(picture(y, x)[c]);
      ++count;
    }
  }
  const RegionColour colour = measure(picture)[2];
  EXPECT_EQ(colour.samples, static_cast<std::uint32_t>(count));
  EXPECT_NEAR(static_cast<double>(colour.blue), sum[0] / count, 2e-3);
  EXPECT_NEAR(static_cast<double>(colour.green), sum[1] / count, 2e-3);
  EXPECT_NEAR(static_cast<double>(colour.red), sum[2] / count, 2e-3);
  EXPECT_EQ(measure(picture)[0].samples, 0U) << "the background is another table's";
}

TEST(RegionColours, GainAndBalanceComeOut) {
  const cv::Mat3b picture = random_picture(2);
  for (const double gain : {0.2, 0.5, 0.9, 1.0, 1.4, 2.0}) {
    const ColourDifference difference =
        compare_colours(measure(picture), measure(relit(picture, {gain, gain, gain})), {});
    EXPECT_NEAR(difference.exposure_ratio, std::max(gain, 1.0 / gain), 0.05 * std::max(gain, 1.0 / gain));
    EXPECT_NEAR(difference.white_balance_ratio, 1.0, 0.04);
  }
  for (const double ratio : {0.6, 1.1, 1.5}) {
    const ColourDifference difference =
        compare_colours(measure(picture), measure(relit(picture, {1.0, 1.0, ratio})), {});
    EXPECT_NEAR(difference.white_balance_ratio, std::max(ratio, 1.0 / ratio), 0.03);
  }
}

TEST(RegionColours, OneShinyRegionDoesNotDecide) {
  const cv::Mat3b picture = random_picture(3);
  cv::Mat3b shiny = picture.clone();
  shiny(cv::Rect(120, 0, 60, kRows)) = cv::Vec3b(250, 250, 250);
  const ColourDifference difference = compare_colours(measure(picture), measure(shiny), {});
  EXPECT_NEAR(difference.exposure_ratio, 1.0, 0.01);
}

TEST(RegionColours, FormatsAndNothing) {
  const cv::Mat3b picture = random_picture(4);
  const RegionColour bgr = measure(picture)[1];
  const RegionColour rgb = measure(picture, PixelFormat::rgb8)[1];
  EXPECT_EQ(bgr.red, rgb.blue);
  EXPECT_EQ(bgr.blue, rgb.red);
  EXPECT_EQ(bgr.green, rgb.green);
  const ColourDifference none = compare_colours({}, measure(picture), {});
  EXPECT_EQ(none.exposure_ratio, 1.0);
  EXPECT_EQ(none.white_balance_ratio, 1.0);
  const ColourDifference black =
      compare_colours(measure(cv::Mat3b(kRows, kColumns, cv::Vec3b(0, 0, 0))), measure(picture), {});
  EXPECT_TRUE(std::isfinite(black.exposure_ratio) && black.exposure_ratio > 100.0);
}

}  // namespace
}  // namespace traygauge
