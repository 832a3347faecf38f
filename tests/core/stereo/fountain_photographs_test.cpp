// Tracks, bundle adjustment and dense surface on photographs of a fountain, with poses from a laser scan
// (Strecha and others 2008). Lengths are scaled down to those of a tray: the fountain's wall is the table.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "core/paper/base/plane_fit.hpp"
#include "core/stereo/dense_stereo.hpp"
#include "tests/core/paper/motion_scenes.hpp"
#include "tests/core/paper/photographs.hpp"
#include "tests/support/sparse_stages.hpp"

namespace traygauge {
namespace {

using test::Photograph;
using test::PoseDeviation;
using test::SurfaceDeviation;

constexpr double kMmPerUnit = 28.0;  // a metre; the basin then ends 78 mm over the wall
constexpr double kTopMm = 85.0;
constexpr double kGroundMm = -2.0;  // joints of the wall
constexpr std::size_t kFirstView = 3;
constexpr std::size_t kViews = 5;
constexpr std::size_t kMiddle = 2;

constexpr int kSiftPoints = 4000;

// As wrong as a card may leave it.
constexpr double kTurnSigmaDeg = 0.3;
constexpr double kShiftSigmaMm = 2.0;

class Fountain : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
    const auto views = test::read_real_views(test::captures_folder() / "real/strecha_fountain_P11");
    for (std::size_t i = 0; i < kViews; ++i) {
      photographs_.push_back(test::read_photograph(views.at(kFirstView + i), kMmPerUnit, {}));
      photographs_.back().labels = cv::Mat1b(photographs_.back().gray.size(), kBackgroundLabel);
    }
    points_ = test::triangulate_features(photographs_, kMiddle, 1.0);
    lay_table_on_the_wall();
  }

  void lay_table_on_the_wall() {
    const Pose camera_from_world = photographs_[kMiddle].view.camera_from_world;
    std::vector<Vec3> in_camera_mm;
    for (const test::ScenePoint& point : points_) in_camera_mm.push_back(camera_from_world * point.point_mm);
    paper::PlaneFitParams params;
    params.threshold_mm = 1.0;
    params.min_iterations = 200;
    Random random(1);
    paper::PlaneFit wall;
    ASSERT_TRUE(paper::fit_plane(in_camera_mm, params, random, wall));
    const Vec3 z = wall.plane.normal;
    const Vec3 x = Vec3::UnitY().cross(z).normalized();
    Pose camera_from_table;
    camera_from_table.rotation << x, z.cross(x), z;
    camera_from_table.translation = wall.plane.offset * z;
    const Pose table_from_world = camera_from_table.inverse() * camera_from_world;
    for (Photograph& photograph : photographs_) {
      photograph.view.camera_from_world = photograph.view.camera_from_world * table_from_world.inverse();
    }
    for (test::ScenePoint& point : points_) point.point_mm = table_from_world * point.point_mm;
  }

  TableCameras truth(std::size_t other) const {
    return {photographs_[kMiddle].view.camera_from_world, photographs_[other].view.camera_from_world};
  }

  // The first camera is known, the second one off by what a card leaves open.
  std::array<CardPrior, 2> disturbed(const TableCameras& cameras, std::uint64_t seed) const {
    constexpr double kKnown = 1e4;
    Vec6 sigma;
    sigma << Vec3::Constant(kTurnSigmaDeg * std::numbers::pi / 180.0), Vec3::Constant(kShiftSigmaMm);
    Random random(seed);
    Vec6 step;
    step << test::random_direction(random), test::random_direction(random);
    const Mat6 information = sigma.array().square().inverse().matrix().asDiagonal();
    return {CardPrior{cameras[0], kKnown * information},
            CardPrior{moved(cameras[1], step.cwiseProduct(sigma)), information}};
  }

  SurfaceDeviation reconstruct(std::size_t other, const TableCameras& cameras) const {
    std::array<Photograph, 2> pair = {photographs_[kMiddle], photographs_[other]};
    for (std::size_t v = 0; v < 2; ++v) {
      pair[v].view.camera_from_world = cameras[v];
      pair[v].labels = cv::Mat1b(pair[v].gray.size(), kFirstItemLabel);
    }
    const DenseStereoParams params;
    test::Allocated<DenseStereoWorkspace> workspace(params);
    std::array<SurfaceGrid, 2> grids;
    DenseStereoReport report;
    const Status status =
        run_dense_stereo({pair[0].stored(), pair[1].stored()}, labels_on_dish(labels_of_single_dish()),
                         kGroundMm, kTopMm, params, *workspace, grids, report);
    EXPECT_TRUE(status.ok()) << name(status.code());
    if (!status.ok()) return {};
    const cv::Mat1f depth_mm = test::depth_map(grids[0], pair[0], 2);
    return test::compare_depth(depth_mm, pair[0], photographs_[other], points_);
  }
  static void print(const char* what, std::size_t other, const SurfaceDeviation& deviation) {
    std::printf("views %zu-%zu, %s pose: %d points (%d without), median %.3f px, 90 %% %.3f px; %.2f mm\n",
                kFirstView + kMiddle, kFirstView + other, what, deviation.compared, deviation.missing,
                deviation.median_px, deviation.percentile90_px, deviation.median_mm);
  }

  std::vector<Photograph> photographs_;
  std::vector<test::ScenePoint> points_;
};

TEST_F(Fountain, TracksCorrectAPoseThatIsOff) {
  test::SparseStages stages;
  for (std::size_t other = 0; other < kViews; ++other) {
    if (other == kMiddle) continue;
    const TableCameras given = truth(other);
    const Photograph& first = photographs_[kMiddle];
    const Photograph& second = photographs_[other];
    const double focal_px = second.view.lens.pinhole.mean_focal_px();
    const std::vector<RayMatch> sift =
        test::match(test::detect(first.view, kSiftPoints), test::detect(second.view, kSiftPoints));
    const double given_px = test::median_epipolar_px(sift, given, focal_px);
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(::testing::Message() << "view " << kFirstView + other << ", seed " << seed);
      const Status status = stages.run({first, second}, disturbed(given, seed), Vec3::Zero(), seed);
      ASSERT_TRUE(status.ok()) << name(status.code());
      const TableCameras& found = stages.bundle().camera_from_table;
      const PoseDeviation deviation = test::compare_motion(found, given);
      const double found_px = test::median_epipolar_px(sift, found, focal_px);
      std::printf(
          "views %zu-%zu, seed %d: %zu tracks, rotation off by %.3f, direction by %.3f degrees; "
          "SIFT off its lines by %.3f px, under the given poses by %.3f px\n",
          kFirstView + kMiddle, kFirstView + other, static_cast<int>(seed), stages.tracks().size(),
          deviation.rotation_deg, deviation.direction_deg, found_px, given_px);
      EXPECT_GT(stages.tracks().size(), 400U);
      EXPECT_LT(deviation.rotation_deg, 0.07);
      EXPECT_LT(deviation.direction_deg, 0.18);
      // The given poses are no better than this themselves.
      EXPECT_LE(found_px, given_px);
    }
  }
}

TEST_F(Fountain, DenseSurfaceMeetsThePointsOfManyViews) {
  test::SparseStages stages;
  for (std::size_t other = 0; other < kViews; ++other) {
    if (other == kMiddle) continue;
    SCOPED_TRACE(::testing::Message() << "view " << kFirstView + other);
    const bool is_neighbour = other + 1 == kMiddle || other == kMiddle + 1;
    const TableCameras given = truth(other);
    const SurfaceDeviation with_given = reconstruct(other, given);
    print("given", other, with_given);
    EXPECT_GT(with_given.compared, 600);
    EXPECT_LT(with_given.median_px, is_neighbour ? 0.3 : 0.5);
    EXPECT_LT(with_given.percentile90_px, is_neighbour ? 0.8 : 1.6);

    ASSERT_TRUE(
        stages.run({photographs_[kMiddle], photographs_[other]}, disturbed(given, 1), Vec3::Zero(), 1).ok());
    // Without a card the length of the motion is unknown.
    Pose motion = second_from_first(stages.bundle().camera_from_table);
    motion.translation *= second_from_first(given).translation.norm() / motion.translation.norm();
    const SurfaceDeviation with_own = reconstruct(other, {given[0], motion * given[0]});
    print("own", other, with_own);
    EXPECT_GT(with_own.compared, 600);
    // A pose that is off by 0.04 degrees moves the surface by about a pixel as a whole.
    EXPECT_LT(with_own.median_px, 1.3);
    EXPECT_LT(with_own.percentile90_px, 2.2);
  }
}

}  // namespace
}  // namespace traygauge
