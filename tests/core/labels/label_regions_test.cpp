#include "core/labels/label_regions.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::view_of;

// Discs of random labels; OpenCV counts and boxes them.
cv::Mat random_labels(cv::RNG& rng, int width, int height) {
  cv::Mat labels = cv::Mat::zeros(height, width, CV_8U);
  constexpr int kLabels[] = {0, 1, 2, 17, 199, 200, 201, 249, 255};
  for (int i = 0; i < 25; ++i) {
    const cv::Point centre(rng.uniform(0, width), rng.uniform(0, height));
    cv::circle(labels, centre, rng.uniform(0, width / 6), cv::Scalar(kLabels[rng.uniform(0, 9)]), cv::FILLED);
  }
  return labels;
}

TEST(LabelRegions, CountsAndBoxesAsOpenCv) {
  for (int seed = 1; seed <= 60; ++seed) {
    cv::RNG rng(static_cast<std::uint64_t>(seed));
    const int width = rng.uniform(1, 150);
    const cv::Mat labels = random_labels(rng, width, rng.uniform(1, 120));
    const LabelRegions regions = measure_regions(view_of(labels));
    for (int label = 0; label < 256; ++label) {
      ASSERT_EQ(regions.pixels[static_cast<std::size_t>(label)], cv::countNonZero(labels == label)) << seed;
    }
    const cv::Mat on_dish = (labels >= 1) & (labels <= 199);
    const cv::Rect box = cv::boundingRect(on_dish);
    ASSERT_EQ(regions.dish_pixels, cv::countNonZero(on_dish)) << seed;
    ASSERT_EQ(regions.dish.empty(), box.empty()) << seed;
    const bool touches =
        !box.empty() && (box.x == 0 || box.y == 0 || box.br().x == labels.cols || box.br().y == labels.rows);
    ASSERT_EQ(regions.touches_edge(regions.dish), touches) << seed;
    if (box.empty()) continue;
    ASSERT_EQ(regions.dish.left, box.x) << seed;
    ASSERT_EQ(regions.dish.top, box.y) << seed;
    ASSERT_EQ(regions.dish.right, box.br().x) << seed;
    ASSERT_EQ(regions.dish.bottom, box.br().y) << seed;
  }
}

TEST(LabelRegions, WhatTouchesTheEdge) {
  cv::Mat labels = cv::Mat::zeros(40, 60, CV_8U);
  labels(cv::Rect(10, 10, 20, 20)).setTo(kDishLabel);
  labels(cv::Rect(0, 0, 10, 5)).setTo(kCardLabel);
  labels(cv::Rect(50, 0, 10, 5)).setTo(201);
  const LabelRegions whole = measure_regions(view_of(labels));
  EXPECT_FALSE(whole.touches_edge(whole.dish));
  EXPECT_TRUE(whole.touches_edge(whole.card));
  EXPECT_FALSE(whole.touches_edge(PixelBox{}));
  labels(cv::Rect(59, 20, 1, 1)).setTo(5);
  const LabelRegions cut = measure_regions(view_of(labels));
  EXPECT_TRUE(cut.touches_edge(cut.dish));
}

TEST(LabelRegions, HonoursTheStride) {
  cv::Mat labels(30, 40, CV_8U, cv::Scalar(1));
  labels(cv::Rect(5, 5, 20, 10)).setTo(0);
  labels(cv::Rect(8, 7, 9, 4)).setTo(3);
  const LabelRegions regions = measure_regions(view_of(labels(cv::Rect(5, 5, 20, 10))));
  EXPECT_EQ(regions.dish_pixels, 36U);
  EXPECT_EQ(regions.dish.left, 3);
  EXPECT_EQ(regions.dish.bottom, 6);
  EXPECT_FALSE(regions.touches_edge(regions.dish));
}

}  // namespace
}  // namespace traygauge
