// Plane rectification against plain ray geometry and OpenCV's projection.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "core/stereo/plane_rectification.hpp"
#include "core/stereo/view_slope.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/opencv_camera.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr double kPlaneMm = 4.0;
constexpr double kDishRadiusMm = 110.0;

cv::Point2d project(const LensModel& lens, const Pose& pose, const Vec3& point) {
  const Vec3 p = pose * point;
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(),
                    test::camera_matrix(lens.pinhole), test::distortion_of(lens), pixels);
  return pixels[0];
}

// Two views of a round dish, with a pattern of the plane painted on it.
struct Scene {
  std::array<cv::Mat1b, 2> gray;
  std::array<cv::Mat1b, 2> labels;
  std::array<StoredView, 2> views;
  std::vector<PlaneRow> rows = std::vector<PlaneRow>(1024);

  Scene(const Vec3& first_mm, const Vec3& second_mm) {
    const std::array<Vec3, 2> centres{first_mm, second_mm};
    for (std::size_t v = 0; v < 2; ++v) {
      StoredView& view = views[v];
      view.lens = test::phone_lens(0.5);
      view.camera_from_table =
          test::looking_at(centres[v], {20.0, -30.0, kPlaneMm}, 0.2 + static_cast<double>(v));
      labels[v] = cv::Mat1b::zeros(view.lens.height, view.lens.width);
      std::vector<cv::Point> outline;
      for (int i = 0; i < 90; ++i) {
        const double angle = i * 2.0 * CV_PI / 90.0;
        outline.push_back(project(
            view.lens, view.camera_from_table,
            {20.0 + kDishRadiusMm * std::cos(angle), -30.0 + kDishRadiusMm * std::sin(angle), kPlaneMm}));
      }
      cv::fillConvexPoly(labels[v], outline, kDishLabel);
      gray[v] = cv::Mat1b(view.lens.height, view.lens.width, std::uint8_t{128});
      const cv::Rect box = cv::boundingRect(outline) & cv::Rect(0, 0, view.lens.width, view.lens.height);
      view.dish = {box.x, box.y, box.x + box.width, box.y + box.height};
      view.gray = {gray[v].data, gray[v].cols, gray[v].rows};
      view.labels = {labels[v].data, labels[v].cols, labels[v].rows};
    }
  }
  Status build(PlaneRectification& grid, const PlaneRectificationParams& params = {}) {
    return grid.build(views, labels_on_dish(labels_of_single_dish()), kPlaneMm, params, rows);
  }
};

Vec3 on_plane(const Vec3& camera_mm, const Vec3& point) {
  return camera_mm + (point - camera_mm) * ((kPlaneMm - camera_mm.z()) / (point.z() - camera_mm.z()));
}

TEST(PlaneRectification, RowsAreEpipolarLinesForAnyMotion) {
  std::mt19937 random(test::random_seed());
  std::uniform_real_distribution<double> offset(-120.0, 120.0);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int built = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Vec3 first(offset(random), -200.0 + offset(random), 450.0 + offset(random));
    const Vec3 second(first.x() + offset(random), first.y() + offset(random),
                      trial % 4 == 0 ? first.z() : first.z() + 0.5 * offset(random));
    Scene scene(first, second);
    PlaneRectification grid;
    if (!scene.build(grid).ok()) continue;
    ++built;
    EXPECT_LE(grid.rows() * grid.columns(), PlaneRectificationParams{}.max_samples);
    for (int i = 0; i < 20; ++i) {
      const int row = static_cast<int>(share(random) * (grid.rows() - 1));
      const double column = share(random) * (grid.columns() - 1);
      const double height_mm = 60.0 * share(random);
      const Vec3 seen = grid.plane_point(row, column);
      const Vec3 point = seen + (first - seen) * (height_mm / (first.z() - kPlaneMm));
      const double partner = column + grid.disparity(row, column, height_mm);
      EXPECT_GE(partner, column);
      EXPECT_LT((grid.plane_point(row, partner) - on_plane(second, point)).norm(), 0.01);
      for (const int view : {0, 1}) {
        const SurfacePoint back = grid.point(row, column, partner, view);
        EXPECT_LT((Vec3(back.x_mm, back.y_mm, back.z_mm) - point).norm(), 0.01);
      }
    }
  }
  EXPECT_GT(built, 15);
}

TEST(PlaneRectification, HoldsTheDishOfBothViews) {
  Scene scene({-60.0, -250.0, 480.0}, {80.0, -230.0, 430.0});
  PlaneRectification grid;
  ASSERT_TRUE(scene.build(grid).ok());
  for (const StoredView& view : scene.views) {
    cv::Mat1b labels(grid.rows(), grid.columns());
    grid.sample_labels(view, labels_on_dish(labels_of_single_dish()),
                       {labels.data, labels.cols, labels.rows});
    const double area_mm2 = cv::countNonZero(labels) * grid.column_step_mm() * grid.row_step_mm();
    EXPECT_NEAR(area_mm2 / (CV_PI * kDishRadiusMm * kDishRadiusMm), 1.0, 0.03);
    cv::Mat1b border = labels.clone();
    border(cv::Rect(3, 3, labels.cols - 6, labels.rows - 6)) = 0;
    EXPECT_EQ(cv::countNonZero(border), 0);
  }
}

// Most of a dish is bare: samples are spent on its food, in both views and with room for a window about it.
TEST(PlaneRectification, SpendsItsSamplesOnTheFood) {
  constexpr std::uint8_t kFood = 7;
  Scene scene({-60.0, -250.0, 480.0}, {80.0, -230.0, 430.0});
  PlaneRectificationParams params;
  params.max_samples = 20'000;
  PlaneRectification bare;
  ASSERT_TRUE(scene.build(bare, params).ok());
  const double bare_step_mm = bare.column_step_mm();
  for (std::size_t v = 0; v < 2; ++v) {
    for (int i = 0; i < 4; ++i) {
      const Vec3 at(40.0 + 8.0 * (i % 2), -10.0 + 8.0 * (i / 2), kPlaneMm);
      cv::circle(scene.labels[v], project(scene.views[v].lens, scene.views[v].camera_from_table, at), 24,
                 kFood, cv::FILLED);
    }
  }
  PlaneRectification grid;
  ASSERT_TRUE(scene.build(grid, params).ok());
  EXPECT_LT(grid.column_step_mm(), 0.5 * bare_step_mm);
  EXPECT_LE(grid.rows() * grid.columns(), params.max_samples);
  for (const StoredView& view : scene.views) {
    cv::Mat1b labels(grid.rows(), grid.columns());
    grid.sample_labels(view, labels_on_dish(labels_of_single_dish()),
                       {labels.data, labels.cols, labels.rows});
    cv::Mat food;
    cv::compare(labels, kFood, food, cv::CMP_EQ);
    EXPECT_GT(cv::countNonZero(food), 3000);
    const cv::Rect inside(4, 4, labels.cols - 8, labels.rows - 8);
    EXPECT_EQ(cv::countNonZero(food(inside)), cv::countNonZero(food));
  }
}

TEST(PlaneRectification, SamplesNoFinerThanThePictures) {
  Scene scene({-60.0, -250.0, 480.0}, {80.0, -230.0, 430.0});
  PlaneRectificationParams params;
  params.max_samples = 1'000'000;
  params.least_step_px = 2.5;
  PlaneRectification grid;
  ASSERT_TRUE(scene.build(grid, params).ok());
  double finest_px = 1e9;
  double coarsest_px = 0.0;
  for (const StoredView& view : scene.views) {
    const double row = 0.5 * grid.rows();
    const double column = 0.5 * grid.columns();
    const cv::Point2d at = project(view.lens, view.camera_from_table, grid.plane_point(row, column));
    const double step_px = std::max(
        cv::norm(project(view.lens, view.camera_from_table, grid.plane_point(row, column + 1.0)) - at),
        cv::norm(project(view.lens, view.camera_from_table, grid.plane_point(row + 1.0, column)) - at));
    finest_px = std::min(finest_px, step_px);
    coarsest_px = std::max(coarsest_px, step_px);
  }
  EXPECT_NEAR(coarsest_px, params.least_step_px, 0.2);
  EXPECT_GT(finest_px, 0.8 * params.least_step_px);
}

TEST(PlaneRectification, SamplesThroughTheLens) {
  Scene scene({-60.0, -250.0, 480.0}, {80.0, -230.0, 430.0});
  const auto wave = [](double x, double y) { return 128.0 + 60.0 * std::sin(0.05 * x) * std::cos(0.04 * y); };
  for (cv::Mat1b& picture : scene.gray) {
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) picture(y, x) = cv::saturate_cast<std::uint8_t>(wave(x, y));
    }
  }
  PlaneRectification grid;
  ASSERT_TRUE(scene.build(grid).ok());
  for (const StoredView& view : scene.views) {
    cv::Mat1b sampled(grid.rows(), grid.columns());
    grid.sample_gray(view, {sampled.data, sampled.cols, sampled.rows});
    for (int y = 0; y < sampled.rows; y += 7) {
      for (int x = 0; x < sampled.cols; x += 5) {
        const cv::Point2d at = project(view.lens, view.camera_from_table, grid.plane_point(y, x));
        if (at.x < 2.0 || at.y < 2.0 || at.x > sampled.cols - 3.0 || at.y > sampled.rows - 3.0) continue;
        ASSERT_NEAR(sampled(y, x), wave(at.x, at.y), 1.5) << x << " " << y;
      }
    }
  }
}

TEST(PlaneRectification, RefusesWhatShowsNoParallax) {
  PlaneRectification grid;
  Scene same({0.0, -200.0, 450.0}, {0.0, -200.0, 450.0});
  EXPECT_EQ(same.build(grid).code(), StatusCode::rectification_failed);
  // One behind the other: the rows meet in the dish.
  Scene behind({20.0, -130.0, 400.0}, {20.0, -155.0, 500.0});
  EXPECT_EQ(behind.build(grid).code(), StatusCode::rectification_failed);
}

TEST(PlaneRectification, RefusesBadInput) {
  PlaneRectification grid;
  const Vec3 first(-60.0, -250.0, 480.0);
  const Vec3 second(80.0, -230.0, 430.0);
  Scene unlabelled(first, second);
  for (cv::Mat1b& labels : unlabelled.labels) labels = 0;
  EXPECT_FALSE(unlabelled.build(grid).ok());
  Scene undefined(first, second);
  undefined.views[1].camera_from_table.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(undefined.build(grid).ok());
  Scene below(first, {80.0, -230.0, -430.0});
  EXPECT_FALSE(below.build(grid).ok());
  Scene outside(first, second);
  outside.views[0].dish.right = outside.views[0].lens.width + 1;
  EXPECT_FALSE(outside.build(grid).ok());
}

// A round item, whose outline's normal points away from its centre.
TEST(PlaneRectification, ViewsLeanOverARoundOutlineAsItsRadiusSays) {
  Scene scene({-60.0, -220.0, 430.0}, {80.0, -200.0, 450.0});
  PlaneRectification grid;
  ASSERT_TRUE(scene.build(grid).ok());
  constexpr std::uint8_t kRoundItem = 7;
  constexpr double kItemRadiusMm = 40.0;
  const Vec2 centre(20.0, -30.0);
  cv::Mat1b labels(grid.rows(), grid.columns(), kDishLabel);
  const auto from_centre = [&](int row, int column) {
    return Vec2(grid.plane_point(row, column).head<2>() - centre);
  };
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (from_centre(row, column).norm() < kItemRadiusMm) labels(row, column) = kRoundItem;
    }
  }
  int outlines = 0;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 1; column + 1 < grid.columns(); ++column) {
      for (const int side : {-1, 1}) {
        if (labels(row, column) != kRoundItem || labels(row, column + side) == kRoundItem) continue;
        const Vec2 radius = from_centre(row, column).normalized();
        // Near the top and bottom row the outline runs along the row, and rows around end elsewhere.
        if (radius.dot(side * grid.row(row).direction) < 0.6) continue;
        for (const int view : {0, 1}) {
          const Vec2 run = (grid.plane_point(row, column) - grid.camera_mm(view)).head<2>();
          const double expected = radius.dot(run) / grid.camera_height_mm(view);
          const RectifiedViewSlope slope(grid, test::view_of(labels), view, row);
          EXPECT_NEAR(slope.at(column, side), expected, 0.15 * run.norm() / grid.camera_height_mm(view));
          ++outlines;
        }
      }
    }
  }
  EXPECT_GT(outlines, 100);
}

}  // namespace
}  // namespace traygauge
