// Edges of drawn pictures as rays: where they are drawn, and where OpenCV's Canny sees them.
#include "core/dish/rim_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/opencv_camera.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

constexpr double kEdgeScale = 0.25;  // 400 × 300 pixels, which are searched as they are
const cv::RotatedRect kDrawnRim({201.0F, 148.0F}, {260.0F, 190.0F}, 15.0F);

struct CollectedEdges {
  RimEdgeParams params;
  std::vector<RimEdge> storage;
  BoundedList<RimEdge> edges;

  explicit CollectedEdges(const RimEdgeParams& params_ = {})
      : params(params_), storage(static_cast<std::size_t>(params_.max_edges)), edges(storage) {}
  void collect(const cv::Mat1b& gray, const LensModel& lens) {
    test::Allocated<RimEdgeWorkspace> space(params);
    collect_rim_edges(test::view_of(gray), lens, params, *space, edges);
  }
};

cv::Mat1b drawn_rim(std::uint8_t inside, std::uint8_t outside) {
  cv::Mat1b gray(300, 400, outside);
  cv::ellipse(gray, kDrawnRim, cv::Scalar(inside), cv::FILLED, cv::LINE_AA);
  cv::GaussianBlur(gray, gray, {}, 0.8);
  return gray;
}

std::vector<cv::Point> drawn_outline() {
  std::vector<cv::Point> polygon;
  cv::ellipse2Poly(kDrawnRim.center, {130, 95}, 15, 0, 360, 1, polygon);
  return polygon;
}

TEST(RimEdges, LieOnADrawnRimWithTheBrighterSideOnTheLeft) {
  const LensModel lens = test::phone_lens(kEdgeScale);
  const std::vector<cv::Point> polygon = drawn_outline();
  for (const bool is_bright : {true, false}) {
    CollectedEdges found;
    found.collect(is_bright ? drawn_rim(200, 90) : drawn_rim(80, 190), lens);
    ASSERT_GT(found.edges.size(), 500U);
    for (const RimEdge& edge : found.edges) {
      // OpenCV's projection takes the rays back to the picture.
      std::vector<cv::Point2d> pixels;
      cv::projectPoints(
          std::vector<cv::Point3d>{{edge.ray.x(), edge.ray.y(), 1.0}, {edge.along.x(), edge.along.y(), 1.0}},
          cv::Vec3d(), cv::Vec3d(), test::camera_matrix(lens.pinhole), test::distortion_of(lens), pixels);
      const auto at = cv::Point2f(pixels[0]);
      EXPECT_LT(std::abs(cv::pointPolygonTest(polygon, at, true)), 1.7);
      const cv::Point2d along = pixels[1] - pixels[0];
      EXPECT_NEAR(cv::norm(along), 1.0, 0.01);
      const cv::Point2d left(along.y, -along.x);  // y points down
      const cv::Point2d inward = cv::Point2d(kDrawnRim.center) - pixels[0];
      EXPECT_EQ(left.dot(inward) > 0.0, is_bright);
    }
  }
}

// What Canny's method with one threshold finds and this does not, or the other way, lies within a pixel.
TEST(RimEdges, AreThoseOfOpenCvsCanny) {
  const LensModel lens = test::phone_lens(kEdgeScale);
  cv::Mat1b gray = test::textured_picture(400, 300, 5);
  CollectedEdges found({160'000, 200'000, 25});
  found.collect(gray, lens);
  cv::Mat1b mine(gray.size(), std::uint8_t{0});
  for (const RimEdge& edge : found.edges) {
    const Vec2 pixel = lens.pixel(edge.ray);
    mine(static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x()))) = 255;
  }
  cv::Mat1b cannys;
  cv::Canny(gray, cannys, 50.0, 50.0, 3, true);  // a strength here is half a gradient
  const auto fraction_near = [](const cv::Mat1b& of, const cv::Mat1b& to) {
    cv::Mat1b wide;
    cv::dilate(to, wide, cv::Mat1b::ones(3, 3));
    return static_cast<double>(cv::countNonZero(of & wide)) / cv::countNonZero(of);
  };
  ASSERT_GT(cv::countNonZero(mine), 1000);
  EXPECT_GT(fraction_near(mine, cannys), 0.93);
  EXPECT_GT(fraction_near(cannys, mine), 0.93);
}

TEST(RimEdges, KeepTheStrongest) {
  const LensModel lens = test::phone_lens(kEdgeScale);
  cv::Mat1b gray = drawn_rim(220, 60);
  for (int i = 0; i < 40; ++i) cv::line(gray, {8 * i, 0}, {8 * i, 40}, cv::Scalar(80), 2);
  CollectedEdges found({160'000, 400, 5});
  found.collect(gray, lens);
  EXPECT_LE(found.edges.size(), 400U);
  EXPECT_GT(found.edges.size(), 200U);
  for (const RimEdge& edge : found.edges) EXPECT_GT(lens.pixel(edge.ray).y(), 42.0);
}

// A larger picture is searched at a smaller size; its edges are where they were.
TEST(RimEdges, OfALargePictureAreFoundInASmallerOne) {
  const LensModel lens = test::phone_lens(4.0 * kEdgeScale);
  cv::Mat1b large;
  cv::resize(drawn_rim(200, 90), large, {1600, 1200}, 0.0, 0.0, cv::INTER_CUBIC);
  CollectedEdges found;
  found.collect(large, lens);
  ASSERT_GT(found.edges.size(), 500U);
  const std::vector<cv::Point> polygon = drawn_outline();
  for (const RimEdge& edge : found.edges) {
    const Vec2 pixel = (lens.pixel(edge.ray).array() + 0.5).matrix() / 4.0 - Vec2::Constant(0.5);
    const cv::Point2f at(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
    EXPECT_LT(std::abs(cv::pointPolygonTest(polygon, at, true)), 1.7);
  }
}

TEST(RimEdges, AreNoneWithoutContrastOrRoom) {
  const LensModel lens = test::phone_lens(kEdgeScale);
  CollectedEdges found;
  found.collect(cv::Mat1b(300, 400, std::uint8_t{120}), lens);
  EXPECT_TRUE(found.edges.empty());
  found.collect(drawn_rim(104, 100), lens);
  EXPECT_TRUE(found.edges.empty());
  found.collect(cv::Mat1b(6, 400, std::uint8_t{120}), lens);
  EXPECT_TRUE(found.edges.empty());
}

}  // namespace
}  // namespace traygauge
