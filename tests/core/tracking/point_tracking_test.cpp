// The tracker on a rendered scene of our own with lens distortion, on bad input, and its pose correction on
// exact points.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/tracking/point_tracking.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/synthetic_scene.hpp"

namespace traygauge {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kFocalPx = 600.0;

LensModel lens_of(const SyntheticCamera& camera) {
  LensModel lens;
  lens.width = camera.width;
  lens.height = camera.height;
  lens.pinhole = camera.pinhole;
  return lens;
}

// The table, and a box of 30 mm on it, whose top is textured like the table.
class TrackedScene : public ::testing::Test {
 protected:
  TrackedScene() : memory_(kWidth, kHeight, params_) {
    scene_.shape = SolidShape::box;
    scene_.height_mm = 30.0;
    const std::array<Vec3, 2> places = {Vec3(-60.0, -40.0, 420.0), Vec3(90.0, -30.0, 400.0)};
    for (std::size_t i = 0; i < 2; ++i) {
      cameras_[i] =
          look_at(places[i], Vec3::Zero(), 0.15 * static_cast<double>(i), kFocalPx, kWidth, kHeight);
      pictures_[i] = render(scene_, cameras_[i], 2);
      // In the table frame, the dish is table here.
      for (std::uint8_t& label : pictures_[i].labels) label = label == 2 ? 2 : 0;
      truth_[i] = cameras_[i].camera_from_world;
      views_[i] = {build_pyramid(pictures_[i].gray_view(), *pyramids_[i]), pictures_[i].label_view(),
                   lens_of(cameras_[i])};
    }
  }
  Status run(const TableCameras& cameras, std::uint64_t seed = 1) {
    Random random(seed);
    return track_points(views_[0], views_[1], cameras, 0.0, params_, random, *memory_, tracks_, report_);
  }
  Vec2 pixel(int view, const Vec2& ray) const {
    return cameras_[static_cast<std::size_t>(view)].pinhole.pixel(ray);
  }

  PointTrackingParams params_;
  SyntheticScene scene_;
  std::array<SyntheticCamera, 2> cameras_;
  std::array<RenderedView, 2> pictures_;
  test::Allocated<PointTrackingWorkspace> memory_;
  test::Allocated<PyramidWorkspace> first_pyramid_{kWidth, kHeight};
  test::Allocated<PyramidWorkspace> second_pyramid_{kWidth, kHeight};
  const std::array<const PyramidWorkspace*, 2> pyramids_ = {&*first_pyramid_, &*second_pyramid_};
  std::array<TrackedView, 2> views_;
  TableCameras truth_;
  std::span<const PointTrack> tracks_;
  PointTrackingReport report_;
};

TEST_F(TrackedScene, TracksEndWhereTheSceneHasThem) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    ASSERT_TRUE(run({truth_[0], test::perturbed(truth_[1], 0.5, 3.0, seed)}, seed).ok());
    EXPECT_EQ(report_.tracks, tracks_.size());
    EXPECT_EQ(report_.corners, report_.not_found + report_.ambiguous + report_.not_aligned +
                                   report_.not_returned + report_.off_line + report_.tracks);
    std::size_t on_box = 0;
    std::size_t right = 0;
    double squares = 0.0;
    for (const PointTrack& track : tracks_) {
      Vec3 point;
      ASSERT_TRUE(surface_point(scene_, cameras_[0], pixel(0, track.first), point));
      if (track.label == 2) ++on_box;
      const double error_px = (cameras_[1].project(point) - pixel(1, track.second)).norm();
      if (error_px > 0.3) continue;
      ++right;
      squares += error_px * error_px / 2.0;
    }
    EXPECT_GT(tracks_.size(), 150U);
    EXPECT_GT(on_box, 15U);
    EXPECT_GT(static_cast<double>(right), 0.97 * static_cast<double>(tracks_.size()));
    EXPECT_LT(std::sqrt(squares / static_cast<double>(right)), 0.05);
  }
}

TEST_F(TrackedScene, TheSecondPoseIsCorrectedAlongTheWay) {
  const auto worst_px = [&](const Pose& pose) {
    double worst = 0.0;
    for (const Vec3& point : {Vec3(-100, -80, 0), Vec3(100, -80, 0), Vec3(0, 90, 0), Vec3(0, 0, 30)}) {
      const Vec3 seen = pose * point;
      const Vec2 there = cameras_[1].pinhole.pixel(seen.head<2>() / seen.z());
      worst = std::max(worst, (there - cameras_[1].project(point)).norm());
    }
    return worst;
  };
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const Pose given = test::perturbed(truth_[1], 0.5, 3.0, seed);
    ASSERT_TRUE(run({truth_[0], given}).ok());
    EXPECT_LT(worst_px(report_.camera_from_table[1]), std::min(0.5, 0.4 * worst_px(given)));
  }
}

TEST_F(TrackedScene, BadInputEndsWithAStatus) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Pose broken = truth_[1];
  broken.translation.x() = kNan;
  EXPECT_FALSE(run({truth_[0], broken}).ok());
  EXPECT_FALSE(run({broken, truth_[1]}).ok());
  Pose from_below = truth_[0];
  from_below.rotation.col(2) *= -1.0;
  EXPECT_FALSE(run({from_below, truth_[1]}).ok());
  // Another place altogether: nothing is found, or nearly nothing that agrees.
  EXPECT_FALSE(run({truth_[0], test::perturbed(truth_[1], 40.0, 300.0, 1)}).ok());
  views_[1].lens.width = kWidth + 1;
  EXPECT_EQ(run(truth_).code(), StatusCode::frame_size_mismatch);
  views_[1].lens.width = kWidth;
  std::fill(pictures_[0].gray.begin(), pictures_[0].gray.end(), std::uint8_t{100});
  views_[0].gray = build_pyramid(pictures_[0].gray_view(), *pyramids_[0]);
  EXPECT_EQ(run(truth_).code(), StatusCode::too_few_features);
}

TEST_F(TrackedScene, WithoutLabelsAllIsTableAndTheBoxIsStillFound) {
  views_[0].labels = {};
  views_[1].labels = {};
  ASSERT_TRUE(run({truth_[0], test::perturbed(truth_[1], 0.3, 2.0, 4)}).ok());
  const EpipolarDistance distance(second_from_first(truth_), kFocalPx);
  std::size_t good = 0;
  for (const PointTrack& track : tracks_)
    good += std::abs(distance(track.first, track.second)) < 0.3 ? 1U : 0U;
  EXPECT_GT(static_cast<double>(good), 0.95 * static_cast<double>(tracks_.size()));
}

// A motion across the lines, further than corners are looked for at first.
TEST_F(TrackedScene, CornersOfABoxThatMovedAreStrays) {
  const Vec3 shift_mm(0.0, 12.0, 0.0);
  SyntheticScene moved = scene_;
  moved.centre_mm += shift_mm.head<2>();
  moved.solid_texture_shift_mm = shift_mm.head<2>();
  pictures_[1] = render(moved, cameras_[1], 2);
  for (std::uint8_t& label : pictures_[1].labels) label = label == 2 ? 2 : 0;
  views_[1].gray = build_pyramid(pictures_[1].gray_view(), *pyramids_[1]);
  views_[1].labels = pictures_[1].label_view();
  ASSERT_TRUE(run(truth_).ok());
  std::size_t right = 0;
  for (const PointTrack& track : report_.strays) {
    Vec3 point;
    ASSERT_TRUE(surface_point(scene_, cameras_[0], pixel(0, track.first), point));
    if (track.label != 2) continue;
    right += (cameras_[1].project(point + shift_mm) - pixel(1, track.second)).norm() < 0.3 ? 1U : 0U;
  }
  EXPECT_GE(right, 4U);
  for (const PointTrack& track : tracks_) EXPECT_NE(track.label, 2);
}

SeenPoint seen_point(const Vec3& table_mm, const TableCameras& cameras) {
  const Vec3 first = cameras[0] * table_mm;
  const Vec3 second = cameras[1] * table_mm;
  return {table_mm, first.head<2>() / first.z(), second.head<2>() / second.z(), false};
}

TEST(PoseCorrection, FindsThePoseFromTableAndOtherPointsDespiteWrongOnes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-150.0, 150.0);
    std::uniform_real_distribution<double> height(0.0, 60.0);
    TableCameras truth;
    truth[0] = look_at({-60, -90, 450}, Vec3::Zero(), 0.0, 1, 1, 1).camera_from_world;
    truth[1] = look_at({80, -60, 430}, Vec3::Zero(), 0.3, 1, 1, 1).camera_from_world;
    std::vector<SeenPoint> points;
    for (int i = 0; i < 60; ++i) {
      const bool on_table = i % 2 == 0;
      points.push_back(seen_point({place(random), place(random), on_table ? 0.0 : height(random)}, truth));
      points.back().height_known = on_table;
      if (i % 10 == 0) points.back().second += Vec2(0.1, -0.05);  // 100 px
    }
    TableCameras corrected = {truth[0], test::perturbed(truth[1], 0.5, 3.0, seed)};
    correct_second_pose(points, 1000.0, {}, corrected);
    for (const SeenPoint& point : points) {
      const Vec2 expected = seen_point(point.table_mm, truth).second;
      EXPECT_LT(1000.0 * (seen_point(point.table_mm, corrected).second - expected).norm(), 0.5);
    }
  }
}

// Epipolar lines do not know how far the camera went: nothing may pull it towards the first one.
TEST(PoseCorrection, WithoutAKnownHeightTheMotionKeepsItsLength) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-150.0, 150.0);
    std::uniform_real_distribution<double> height(0.0, 60.0);
    TableCameras truth;
    truth[0] = look_at({-20, -40, 450}, Vec3::Zero(), 0.0, 1, 1, 1).camera_from_world;
    truth[1] = look_at({25, -35, 450}, Vec3::Zero(), 0.05, 1, 1, 1).camera_from_world;
    std::uniform_real_distribution<double> mistake(-0.03, 0.03);
    std::vector<SeenPoint> points;
    for (int i = 0; i < 50; ++i) {
      points.push_back(seen_point({place(random), place(random), height(random)}, truth));
      if (i % 5 == 0) points.back().second += Vec2(mistake(random), mistake(random));
    }
    TableCameras corrected = {truth[0], test::perturbed(truth[1], 0.5, 3.0, seed)};
    const double given_mm = second_from_first(corrected).translation.norm();
    correct_second_pose(points, 1000.0, {}, corrected);
    EXPECT_NEAR(second_from_first(corrected).translation.norm(), given_mm, 6.0);
    const EpipolarDistance distance(second_from_first(corrected), 1000.0);
    int right = 0;
    for (const SeenPoint& point : points) right += std::abs(distance(point.first, point.second)) < 0.5;
    EXPECT_GE(right, 38);
  }
}

}  // namespace
}  // namespace traygauge
