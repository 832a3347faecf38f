// Dishes placed by their outlines, in closed form and by rendered label pictures.
#include "core/dish/dish_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/dish/dish_outline.hpp"
#include "tests/core/dish/edge_outlines.hpp"
#include "tests/core/stereo/capture_scene.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"

namespace traygauge {
namespace {

using test::Allocated;
using test::camera_at;
using test::outline_of;
using test::two_cameras;

DishModel model_of(double width_mm, double depth_mm, double edge_mm) {
  DishModel model;
  model.outer_size_mm = {width_mm, depth_mm};
  model.rim_height_mm = edge_mm;
  return model;
}

class Placement : public ::testing::Test {
 protected:
  Status place(const std::vector<DishModel>& candidates) {
    return fit_dish_pose({rays_[0], rays_[1]}, cameras_, {test::kOutlineFocalPx, test::kOutlineFocalPx},
                         candidates, {}, *workspace_, placed_);
  }
  void show(const DishPose& place) {
    for (std::size_t view = 0; view < 2; ++view) rays_[view] = outline_of(place, cameras_[view]);
  }

  TableCameras cameras_ = two_cameras();
  std::array<std::vector<Vec2>, 2> rays_;
  Allocated<DishPoseWorkspace> workspace_{std::size_t{1024}};
  PlacedDish placed_;
};

TEST_F(Placement, FindsAnOvalDishWhereItStands) {
  const DishPose truth{{12.0, -20.0}, 0.6, 23.4, {300.0, 210.0}, 1.8};
  show(truth);
  ASSERT_TRUE(place({model_of(300.0, 210.0, 23.4)}).ok());
  EXPECT_LT((placed_.place.centre_mm - truth.centre_mm).norm(), 0.02);
  EXPECT_NEAR(std::remainder(placed_.place.azimuth_rad - truth.azimuth_rad, std::numbers::pi), 0.0, 1e-3);
  EXPECT_NEAR(placed_.place.edge_height_mm, 23.4, 0.05);
  EXPECT_LT(placed_.fit.rms_px, 0.1);
  EXPECT_EQ(placed_.fit.inliers, placed_.fit.points);
}

TEST_F(Placement, TheOrderOfTheAxesDoesNotMatter) {
  const DishPose truth{{12.0, -20.0}, 0.6, 23.4, {300.0, 210.0}, 1.0};
  show(truth);
  ASSERT_TRUE(place({model_of(210.0, 300.0, 23.4)}).ok());
  EXPECT_NEAR(std::remainder(placed_.place.azimuth_rad - truth.azimuth_rad - 0.5 * std::numbers::pi,
                             std::numbers::pi),
              0.0, 1e-3);
}

TEST_F(Placement, ChoosesAmongKnownDishes) {
  const std::vector<DishModel> known = {model_of(260.0, 260.0, 21.4), model_of(300.0, 210.0, 23.4),
                                        model_of(230.0, 230.0, 39.4), model_of(150.0, 150.0, 55.0)};
  for (std::size_t i = 0; i < known.size(); ++i) {
    show({{-15.0, 10.0},
          0.3,
          known[i].rim_height_mm + 0.4,
          {known[i].outer_size_mm[0] - 0.5, known[i].outer_size_mm[1] - 0.5},
          1.5});
    ASSERT_TRUE(place(known).ok()) << i;
    EXPECT_EQ(placed_.candidate, static_cast<int>(i));
  }
}

TEST_F(Placement, SaysWhatAnUnknownDishMeasures) {
  show({{0.0, 0.0}, 0.0, 30.0, {200.0, 200.0}, 1.0});
  EXPECT_EQ(place({model_of(260.0, 260.0, 21.4)}).code(), StatusCode::dish_unknown);
  EXPECT_NEAR(placed_.measured.size_mm[0], 200.0, 1.0);
  EXPECT_NEAR(placed_.measured.edge_height_mm, 30.0, 1.0);
}

TEST_F(Placement, RefusesTheOutlineOfAnotherPicture) {
  const DishPose truth{{12.0, -20.0}, 0.0, 21.4, {260.0, 260.0}, 1.0};
  show(truth);
  rays_[1] = outline_of(truth, camera_at(15.0, 170.0));
  EXPECT_EQ(place({model_of(260.0, 260.0, 21.4)}).code(), StatusCode::labels_inconsistent);
}

TEST_F(Placement, WithstandsAHiddenStretch) {
  const DishPose truth{{12.0, -20.0}, 0.0, 21.4, {260.0, 260.0}, 1.0};
  show(truth);
  for (std::size_t i = 0; i < 75; ++i) {  // a quarter of the outline is that of a napkin 30 px further out
    rays_[0][i] *= 1.0 + 30.0 / 350.0;
    rays_[1][(i + 120) % 300] *= 1.0 + 30.0 / 350.0;
  }
  ASSERT_TRUE(place({model_of(260.0, 260.0, 21.4)}).ok());
  EXPECT_LT((placed_.place.centre_mm - truth.centre_mm).norm(), 0.1);
  EXPECT_LT(placed_.fit.inliers, placed_.fit.points);
}

// A bowl from the side, whose outer wall is a part of its outlines on the near side. As far outside on the
// far side lies something else.
TEST_F(Placement, KnowsABowlsWallBelowItsEdge) {
  cameras_ = {camera_at(20.0, 20.0), camera_at(38.0, 50.0)};
  const DishPose truth{{12.0, -20.0}, 0.0, 60.0, {150.0, 150.0}, 1.0};
  const DishPose foot{truth.centre_mm, 0.0, 25.0, {140.0, 140.0}, 0.0};
  const DishPose napkin{truth.centre_mm, 0.0, 60.0, {166.0, 166.0}, 0.0};
  for (const bool is_near : {true, false}) {
    show(truth);
    int moved = 0;
    for (std::size_t view = 0; view < 2; ++view) {
      const RimProjection edge(truth, cameras_[view], test::kOutlineFocalPx);
      const std::vector<Vec2> lower = outline_of(foot, cameras_[view]);
      const std::vector<Vec2> wider = outline_of(napkin, cameras_[view]);
      for (std::size_t i = 0; i < lower.size(); ++i) {
        double outside_px = 0.0;
        ASSERT_TRUE(edge.residual(lower[i], outside_px));
        if (is_near ? outside_px < 8.0 : outside_px > -60.0) continue;
        rays_[view][i] = is_near ? lower[i] : wider[i];
        ++moved;
      }
    }
    ASSERT_GT(moved, 60);
    ASSERT_TRUE(place({model_of(150.0, 150.0, 60.0)}).ok());
    EXPECT_LT((placed_.place.centre_mm - truth.centre_mm).norm(), 0.3);
    EXPECT_LT(placed_.fit.inliers, 0.95 * placed_.fit.points);
    if (is_near) {
      EXPECT_GT(placed_.fit.explained_fraction(), 0.99);
    } else {
      EXPECT_LT(placed_.fit.explained_fraction(), 0.95);
    }
  }
}

TEST_F(Placement, NeedsPoints) {
  rays_[0].resize(5);
  EXPECT_EQ(place({model_of(260.0, 260.0, 21.4)}).code(), StatusCode::rim_not_found);
  show({{0.0, 0.0}, 0.0, 30.0, {200.0, 200.0}, 1.0});
  EXPECT_EQ(place({}).code(), StatusCode::dish_unknown);
  for (Vec2& ray : rays_[0]) ray.setConstant(std::nan(""));
  EXPECT_FALSE(place({model_of(200.0, 200.0, 30.0)}).ok());
}

TEST(RimProjection, DerivativesAreTheNumericOnes) {
  const DishPose place{{12.0, -20.0}, 0.6, 23.4, {300.0, 210.0}, 1.3};
  const Pose camera = camera_at(24.0, 50.0);
  // Off the outline by a third of a pixel: the residual is exact to first order only.
  DishPose shown = place;
  shown.size_mm = {300.2, 210.2};
  for (const Vec2& ray : outline_of(shown, camera, 60)) {
    double residual = 0.0;
    Eigen::Matrix<double, 6, 1> by_camera;
    PlaceVector by_place;
    const RimProjection at(place, camera, test::kOutlineFocalPx);
    ASSERT_TRUE(at.linearise(ray, residual, by_camera, by_place));
    const auto difference = [&](const DishPose& place_up, const Pose& camera_up, const DishPose& place_down,
                                const Pose& camera_down, double h) {
      double up = 0.0;
      double down = 0.0;
      EXPECT_TRUE(RimProjection(place_up, camera_up, test::kOutlineFocalPx).residual(ray, up));
      EXPECT_TRUE(RimProjection(place_down, camera_down, test::kOutlineFocalPx).residual(ray, down));
      return (up - down) / (2.0 * h);
    };
    for (int k = 0; k < 6; ++k) {
      const double h = k < 3 ? 1e-6 : 1e-3;
      const Eigen::Matrix<double, 6, 1> step = h * Eigen::Matrix<double, 6, 1>::Unit(k);
      const double numeric = difference(place, moved(camera, step), place, moved(camera, -step), h);
      EXPECT_NEAR(numeric, by_camera[k],
                  0.02 * (k < 3 ? test::kOutlineFocalPx : test::kOutlineFocalPx / 500.0))
          << k;
    }
    for (int k = 0; k < kPlaceParameters; ++k) {
      const double h = k == kPlaceAzimuth ? 1e-6 : 1e-3;
      const PlaceVector step = h * PlaceVector::Unit(k);
      const double numeric = difference(place_from_vector(as_vector(place) + step), camera,
                                        place_from_vector(as_vector(place) - step), camera, h);
      EXPECT_NEAR(numeric, by_place[k],
                  0.02 * (k == kPlaceAzimuth ? test::kOutlineFocalPx : test::kOutlineFocalPx / 500.0))
          << k;
    }
  }
}

// A label picture sampled at pixel centres, with a lens.
TEST(DishOutline, LiesOnTheDishsEdgeAndLeavesItsFoodOut) {
  const LensModel lens = test::phone_lens(0.5);
  const double radius = 0.3;
  cv::Mat1b labels(lens.height, lens.width, std::uint8_t{0});
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      Vec2 ray;
      ASSERT_TRUE(lens.undistort_pixel(Vec2(x, y), ray));
      if (ray.norm() < radius) labels(y, x) = 201;
      if ((ray - Vec2(0.0, radius)).norm() < 0.1) labels(y, x) = 7;     // food that hangs over the rim
      if ((ray - Vec2(radius, 0.0)).norm() < 0.08) labels(y, x) = 202;  // another dish before it
    }
  }
  DishRegion region{201, {}};
  region.on_dish.add(201);
  region.on_dish.add(7);
  Allocated<DishOutlineWorkspace> workspace(std::size_t{8192});
  std::vector<Vec2> storage(1024);
  BoundedList<Vec2> rays{std::span<Vec2>(storage)};
  ASSERT_TRUE(trace_dish_outline(test::view_of(labels), lens, region, {}, *workspace, rays).ok());
  EXPECT_GT(rays.size(), 120U);
  double sum = 0.0;
  for (const Vec2& ray : rays.items()) {
    EXPECT_NEAR(ray.norm(), radius, 0.6 / 700.0);
    EXPECT_GT((ray - Vec2(0.0, radius)).norm(), 0.09);
    EXPECT_GT((ray - Vec2(radius, 0.0)).norm(), 0.07);
    sum += ray.norm() - radius;
  }
  EXPECT_LT(std::abs(sum / static_cast<double>(rays.size())) * 700.0, 0.05);
  region.dish = 33;
  region.on_dish = {};
  region.on_dish.add(33);
  EXPECT_EQ(trace_dish_outline(test::view_of(labels), lens, region, {}, *workspace, rays).code(),
            StatusCode::no_dish_label);
}

}  // namespace
}  // namespace traygauge
