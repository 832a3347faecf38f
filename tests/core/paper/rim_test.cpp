#include "core/paper/surface/rim.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "core/dish/rim_ellipse.hpp"
#include "tests/core/stereo/capture_scene.hpp"
#include "tests/core/stereo/synthetic_scene.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge::paper {
namespace {

using test::Allocated;

TEST(DishContour, RunsAroundTheLargestRegionOnly) {
  cv::Mat1b labels(100, 120, std::uint8_t{0});
  labels(cv::Rect(30, 20, 50, 60)) = std::uint8_t{1};
  labels(cv::Rect(50, 40, 10, 20)) = std::uint8_t{0};    // a hole
  labels(cv::Rect(40, 30, 8, 8)) = std::uint8_t{5};      // an item belongs to the dish
  labels(cv::Rect(5, 45, 4, 10)) = std::uint8_t{1};      // a speck in the middle rows
  labels(cv::Rect(80, 20, 10, 30)) = std::uint8_t{255};  // the card touches
  Allocated<DishContour> contour(std::size_t{4096});
  ASSERT_TRUE(trace_dish_contour(test::view_of(labels), *contour).ok());
  ASSERT_EQ(contour->sides.size(), 2U * (50U + 60U));
  int against_table = 0;
  for (const BorderSide& side : contour->sides) {
    against_table += side.against_table ? 1 : 0;
    EXPECT_TRUE(side.x_px == 29.5F || side.x_px == 79.5F || side.y_px == 19.5F || side.y_px == 79.5F);
  }
  EXPECT_EQ(against_table, 2 * (50 + 60) - 30);
}

TEST(DishContour, SaysWhenThereIsNoneOrTooMuch) {
  cv::Mat1b labels(50, 50, std::uint8_t{0});
  Allocated<DishContour> contour(std::size_t{64});
  EXPECT_EQ(trace_dish_contour(test::view_of(labels), *contour).code(), StatusCode::no_dish_label);
  labels(cv::Rect(5, 5, 40, 40)) = std::uint8_t{1};
  EXPECT_EQ(trace_dish_contour(test::view_of(labels), *contour).code(), StatusCode::out_of_memory);
}

TEST(DishContour, TheEdgeOfThePictureIsNotTheTable) {
  cv::Mat1b labels(40, 40, std::uint8_t{1});
  Allocated<DishContour> contour(std::size_t{4096});
  ASSERT_TRUE(trace_dish_contour(test::view_of(labels), *contour).ok());
  for (const BorderSide& side : contour->sides) EXPECT_FALSE(side.against_table);
}

TEST(DishContour, TheCurveLiesOnTheTrueCircleToATenthOfAPixel) {
  const double radius = 190.3;
  const Vec2 centre(239.7, 241.2);
  cv::Mat1b labels(480, 480, std::uint8_t{0});
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 480; ++x) labels(y, x) = (Vec2(x, y) - centre).norm() < radius ? 1 : 0;
  }
  Allocated<DishContour> contour(std::size_t{4096});
  ASSERT_TRUE(trace_dish_contour(test::view_of(labels), *contour).ok());
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < contour->sides.size(); ++i) {
    ContourCurve curve;
    ASSERT_TRUE(fit_contour_curve(*contour, i, {}, curve));
    const double error = (curve.point(0.0) - centre).norm() - radius;
    EXPECT_LT(std::abs(error), 0.5);
    EXPECT_GT(curve.inward.dot(centre - curve.origin), 0.0);
    sum += error;
    squares += error * error;
  }
  const auto count = static_cast<double>(contour->sides.size());
  EXPECT_LT(std::abs(sum / count), 0.02);
  EXPECT_LT(std::sqrt(squares / count), 0.12);
}

struct RimScene {
  double semi_x_mm;
  double semi_y_mm;
  double height_mm;
};

class RimOfTwoViews : public ::testing::TestWithParam<RimScene> {};

TEST_P(RimOfTwoViews, TiltWithinATenthOfADegreeAndHeightWithinAFifthOfAMillimetre) {
  const RimScene& scene = GetParam();
  Allocated<RimWorkspace> space(std::size_t{8192}, std::size_t{4096});
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const double azimuth = 6.28 * uniform(generator);
    const double tilt = 0.1 + 0.4 * uniform(generator);
    const auto first = test::look_at_origin(480.0 + 80.0 * uniform(generator), tilt, azimuth);
    const auto second = test::look_at_origin(500.0, std::abs(tilt - 0.3), azimuth + 0.3);
    const cv::Mat1b first_labels =
        test::render_ellipse(first, scene.semi_x_mm, scene.semi_y_mm, scene.height_mm);
    const cv::Mat1b second_labels =
        test::render_ellipse(second, scene.semi_x_mm, scene.semi_y_mm, scene.height_mm);
    const CameraPair cameras{first.camera, second.camera, test::relative_pose(first, second)};
    ASSERT_TRUE(
        collect_rim_points({test::view_of(first_labels), test::view_of(second_labels), cameras}, {}, *space)
            .ok());
    Random random(seed);
    PlaneFit fit;
    ASSERT_TRUE(fit_rim_plane(cameras.second_from_first, {}, random, space->points_mm, fit).ok());
    const Plane truth = test::plane_in_view({Vec3::UnitZ(), scene.height_mm}, first);
    const Vec3 centre = first.camera_from_world * Vec3(0.0, 0.0, scene.height_mm);
    EXPECT_LT(std::asin(fit.plane.normal.cross(truth.normal).norm()) * 180.0 / CV_PI, 0.1);
    EXPECT_LT(std::abs(fit.plane.height(centre)), 0.2);

    const Result<RimEllipse> ellipse = fit_rim_size(space->points_mm.items(), fit.plane);
    ASSERT_TRUE(ellipse.ok());
    EXPECT_NEAR(ellipse->size_mm[0], 2.0 * std::max(scene.semi_x_mm, scene.semi_y_mm), 0.8);
    EXPECT_NEAR(ellipse->size_mm[1], 2.0 * std::min(scene.semi_x_mm, scene.semi_y_mm), 0.8);
    EXPECT_LT((ellipse->centre_mm - centre).norm(), 0.6);
  }
}

INSTANTIATE_TEST_SUITE_P(Rim, RimOfTwoViews,
                         ::testing::Values(RimScene{130.0, 130.0, 22.0}, RimScene{105.0, 150.0, 24.0},
                                           RimScene{76.0, 76.0, 55.0}));

TEST(Rim, TheCrestIsTheDepthInsideTheBorder) {
  const auto view = test::look_at_origin(480.0, 0.3, 0.5);
  const cv::Mat1b labels = test::render_ellipse(view, 130.0, 130.0, 22.0);
  const auto surface = test::render_height_field(view, 22.0, 1e6, [](double, double) { return 22.0; });
  Allocated<RimWorkspace> space(std::size_t{8192}, std::size_t{4096});
  ASSERT_TRUE(
      collect_rim_crest(test::view_of(labels), test::view_of(surface.depth_mm), view.camera, {}, *space)
          .ok());
  EXPECT_GT(space->points_mm.size(), 300U);
  const Plane truth = test::plane_in_view({Vec3::UnitZ(), 22.0}, view);
  for (const Vec3& point : space->points_mm) EXPECT_NEAR(truth.height(point), 0.0, 0.05);

  const cv::Mat1f unknown(labels.size(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(collect_rim_crest(test::view_of(labels), test::view_of(unknown), view.camera, {}, *space).code(),
            StatusCode::rim_not_found);
}

}  // namespace
}  // namespace traygauge::paper
