// Borders of dishes in label pictures, against OpenCV's components, and circles as curves.
#include "core/dish/dish_contour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>
#include <utility>

#include "tests/support/allocated.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kContourItem = 12;

using SidePlace = std::pair<int, int>;  // doubled

// The outer sides of the largest component (of side by side pixels) with its holes filled.
std::multiset<SidePlace> sides_of_largest(const cv::Mat& on_dish, double& fraction) {
  cv::Mat1b framed;
  cv::copyMakeBorder(on_dish, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::Mat1i numbers;
  cv::Mat1i stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(framed, numbers, stats, centres, 4);
  int largest = 1;
  for (int i = 2; i < count; ++i)
    if (stats(i, cv::CC_STAT_AREA) > stats(largest, cv::CC_STAT_AREA)) largest = i;
  fraction = static_cast<double>(stats(largest, cv::CC_STAT_AREA)) / cv::countNonZero(framed);
  const cv::Mat beside = numbers != largest;
  cv::Mat1i outside;
  cv::connectedComponents(beside, outside, 8);
  const int frame = outside(0, 0);
  std::multiset<SidePlace> sides;
  for (int y = 1; y + 1 < framed.rows; ++y) {
    for (int x = 1; x + 1 < framed.cols; ++x) {
      if (numbers(y, x) != largest) continue;
      if (outside(y, x - 1) == frame) sides.insert({2 * (x - 1) - 1, 2 * (y - 1)});
      if (outside(y, x + 1) == frame) sides.insert({2 * (x - 1) + 1, 2 * (y - 1)});
      if (outside(y - 1, x) == frame) sides.insert({2 * (x - 1), 2 * (y - 1) - 1});
      if (outside(y + 1, x) == frame) sides.insert({2 * (x - 1), 2 * (y - 1) + 1});
    }
  }
  return sides;
}

TEST(DishContour, WalksTheOuterSidesOfTheLargestPiece) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> place(-4, 74);
  std::uniform_int_distribution<int> radius(2, 12);
  int traced = 0;
  for (int round = 0; round < 300; ++round) {
    cv::Mat1b labels(70, 70, kBackgroundLabel);
    cv::circle(labels, {35, 35}, 22, cv::Scalar(kDishLabel), cv::FILLED);
    for (int i = 0; i < 8; ++i) {
      const int value = i % 4 == 0 ? kContourItem : i % 4 == 1 ? kDishLabel : i % 4 == 2 ? kCardLabel : 0;
      cv::circle(labels, {place(random), place(random)}, radius(random), cv::Scalar(value), cv::FILLED);
    }
    const cv::Mat on_dish = (labels == kDishLabel) | (labels == kContourItem);
    double fraction = 0.0;
    const std::multiset<SidePlace> truth = sides_of_largest(on_dish, fraction);
    if (fraction < 0.55) continue;
    test::Allocated<DishContour> contour(std::size_t{4000});
    ASSERT_TRUE(trace_dish_contour(test::view_of(labels), *contour).ok());
    std::multiset<SidePlace> found;
    const auto sides = contour->sides.items();
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const BorderSide& side = sides[i];
      found.insert(
          {static_cast<int>(std::lround(2.0F * side.x_px)), static_cast<int>(std::lround(2.0F * side.y_px))});
      const Vec2 to_next = contour->place((i + 1) % sides.size()) - contour->place(i);
      EXPECT_LE(to_next.norm(), 1.0 + 1e-6);  // in order, and closed
      // One of the two pixels beside it is of the dish, the other is not.
      const bool is_upright = std::abs(side.x_px - std::round(side.x_px)) > 0.25F;
      const Vec2 across = is_upright ? Vec2(0.5, 0.0) : Vec2(0.0, 0.5);
      const auto label_at = [&](const Vec2& at) {
        const cv::Point pixel(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())));
        return cv::Rect(0, 0, 70, 70).contains(pixel) ? labels(pixel) : kCardLabel;
      };
      std::uint8_t inner = label_at(contour->place(i) - across);
      std::uint8_t outer = label_at(contour->place(i) + across);
      if (is_on_dish(outer)) std::swap(inner, outer);
      EXPECT_EQ(side.label, inner);
      EXPECT_EQ(side.against_table, outer == kBackgroundLabel);
    }
    ASSERT_EQ(found, truth) << round;
    ++traced;
  }
  EXPECT_GT(traced, 150);
}

// The mean row of all pixels lies between the two pieces.
TEST(DishContour, FindsTheLargestPieceThoughTheOtherIsFarFromIt) {
  cv::Mat1b labels(70, 70, kBackgroundLabel);
  labels(cv::Rect(10, 2, 50, 6)) = kDishLabel;
  labels(cv::Rect(10, 62, 50, 5)) = kDishLabel;
  test::Allocated<DishContour> contour(std::size_t{4000});
  ASSERT_TRUE(trace_dish_contour(test::view_of(labels), *contour).ok());
  EXPECT_EQ(contour->sides.size(), 2U * (50 + 6));
}

TEST(DishContour, RefusesWhatItCannotWalk) {
  cv::Mat1b labels(70, 70, kBackgroundLabel);
  test::Allocated<DishContour> contour(std::size_t{4 * 41});
  EXPECT_EQ(trace_dish_contour(test::view_of(labels), *contour).code(), StatusCode::no_dish_label);
  labels(cv::Rect(10, 10, 41, 41)).setTo(kDishLabel);
  EXPECT_TRUE(trace_dish_contour(test::view_of(labels), *contour).ok());
  EXPECT_EQ(contour->sides.size(), 4U * 41U);
  labels(cv::Rect(10, 10, 42, 42)).setTo(kDishLabel);
  EXPECT_EQ(trace_dish_contour(test::view_of(labels), *contour).code(), StatusCode::out_of_memory);
  // In many pieces, none of them most of it.
  labels.setTo(kBackgroundLabel);
  for (int i = 0; i < 9; ++i) labels(cv::Rect(4 + 20 * (i % 3), 4 + 20 * (i / 3), 8, 8)).setTo(kDishLabel);
  EXPECT_EQ(trace_dish_contour(test::view_of(labels), *contour).code(), StatusCode::no_dish_label);
}

TEST(DishContour, CurveOfADiscHasItsRadiusAndTangent) {
  for (const double radius_px : {80.0, 150.0, 300.0}) {
    const int side = static_cast<int>(2.0 * radius_px) + 20;
    const Vec2 centre(0.5 * side + 0.3, 0.5 * side - 0.2);
    cv::Mat1b labels(side, side, kBackgroundLabel);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x)
        if ((Vec2(x, y) - centre).norm() < radius_px) labels(y, x) = kDishLabel;
    }
    test::Allocated<DishContour> contour(static_cast<std::size_t>(9.0 * radius_px));
    ASSERT_TRUE(trace_dish_contour(test::view_of(labels), *contour).ok());
    double bend_sum = 0.0;
    int curves = 0;
    for (std::size_t i = 0; i < contour->sides.size(); i += 7) {
      ContourCurve curve;
      ASSERT_TRUE(fit_contour_curve(*contour, i, {}, curve));
      const Vec2 outward = curve.point(0.0) - centre;
      EXPECT_NEAR(outward.norm(), radius_px, 0.6);
      // Clockwise in the picture, whose y points down.
      const Vec2 along = Vec2(-outward.y(), outward.x()).normalized();
      EXPECT_GT(curve.direction(0.0).dot(along), 0.99);
      EXPECT_LT(curve.inward.dot(outward), 0.0);
      bend_sum += 2.0 * curve.coefficients[2];
      ++curves;
    }
    EXPECT_NEAR(bend_sum / curves, 1.0 / radius_px, 0.1 / radius_px);
  }
}

TEST(DishContour, HasNoCurveBesideTheCardOrWhenShort) {
  cv::Mat1b labels(200, 200, kBackgroundLabel);
  cv::circle(labels, {100, 100}, 80, cv::Scalar(kDishLabel), cv::FILLED);
  labels(cv::Rect(170, 60, 30, 80)).setTo(kCardLabel);
  test::Allocated<DishContour> contour(std::size_t{2000});
  ASSERT_TRUE(trace_dish_contour(test::view_of(labels), *contour).ok());
  int refused = 0;
  for (std::size_t i = 0; i < contour->sides.size(); ++i) {
    ContourCurve curve;
    const bool is_fitted = fit_contour_curve(*contour, i, {}, curve);
    if (!contour->sides[i].against_table) {
      EXPECT_FALSE(is_fitted);
    }
    refused += is_fitted ? 0 : 1;
  }
  EXPECT_GT(refused, 50);
  EXPECT_LT(refused, static_cast<int>(contour->sides.size()) / 2);
  cv::Mat1b small(20, 20, kBackgroundLabel);
  small(cv::Rect(5, 5, 10, 10)).setTo(kDishLabel);
  ASSERT_TRUE(trace_dish_contour(test::view_of(small), *contour).ok());
  ContourCurve curve;
  EXPECT_FALSE(fit_contour_curve(*contour, 0, {}, curve));
}

}  // namespace
}  // namespace traygauge
