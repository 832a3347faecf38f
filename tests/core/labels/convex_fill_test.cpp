// Filled outlines against OpenCV's test of points in polygons.
#include "core/labels/convex_fill.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kFilled = 9;

int filled_pixels(std::span<const Vec2> outline) {
  cv::Mat1b labels(40, 50, std::uint8_t{0});
  fill_convex(test::view_of(labels), outline, kFilled);
  return cv::countNonZero(labels);
}

// Hulls of random points that reach beyond the picture on every side.
TEST(ConvexFill, TakesThePixelsWhoseCentresLieInside) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<float> place(-30.0F, 80.0F);
  std::uniform_int_distribution<int> count(3, 12);
  int filled = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<cv::Point2f> points(static_cast<std::size_t>(count(random)));
    for (cv::Point2f& point : points) point = {place(random), place(random)};
    std::vector<cv::Point2f> hull;
    cv::convexHull(points, hull, round % 2 == 0);
    std::vector<Vec2> outline;
    for (const cv::Point2f& corner : hull) outline.emplace_back(corner.x, corner.y);
    cv::Mat1b labels(40, 50, std::uint8_t{1});
    fill_convex(test::view_of(labels), outline, kFilled);
    for (int y = 0; y < labels.rows; ++y) {
      for (int x = 0; x < labels.cols; ++x) {
        const double inside =
            cv::pointPolygonTest(hull, {static_cast<float>(x), static_cast<float>(y)}, true);
        if (std::abs(inside) < 1e-3) continue;  // to either's rounding
        ASSERT_EQ(labels(y, x), inside > 0.0 ? kFilled : 1) << x << " " << y;
        filled += inside > 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(filled, 20'000);
}

TEST(ConvexFill, TakesInItsBorder) {
  const std::array<Vec2, 4> square = {Vec2(3.0, 5.0), Vec2(9.0, 5.0), Vec2(9.0, 8.0), Vec2(3.0, 8.0)};
  EXPECT_EQ(filled_pixels(square), 7 * 4);
  const std::array<Vec2, 4> between = {Vec2(3.1, 5.1), Vec2(8.9, 5.1), Vec2(8.9, 7.9), Vec2(3.1, 7.9)};
  EXPECT_EQ(filled_pixels(between), 5 * 2);
}

TEST(ConvexFill, FillsNothingWithoutAnOutlineInThePicture) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  EXPECT_EQ(filled_pixels({}), 0);
  EXPECT_EQ(filled_pixels(std::array<Vec2, 1>{Vec2(3.0, 4.0)}), 0);
  EXPECT_EQ(filled_pixels(std::array<Vec2, 3>{Vec2(60.0, 4.0), Vec2(90.0, 4.0), Vec2(70.0, 30.0)}), 0);
  EXPECT_EQ(filled_pixels(std::array<Vec2, 3>{Vec2(10.0, -44.0), Vec2(30.0, -44.0), Vec2(20.0, -1.0)}), 0);
  EXPECT_EQ(filled_pixels(std::array<Vec2, 3>{Vec2(kNan, kNan), Vec2(kNan, kNan), Vec2(kNan, kNan)}), 0);
  EXPECT_EQ(filled_pixels(std::array<Vec2, 3>{Vec2(1.0, 1.0), Vec2(30.0, kFar), Vec2(20.0, 3.0)}), 0);
}

}  // namespace
}  // namespace traygauge
