// The bundle adjustment on closed-form trays: its errors are those that it states, and what is wrong in the
// scene does no harm.
#include "core/adjustment/bundle_adjustment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "tests/core/adjustment/bundle_scene.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

using test::Allocated;
using test::BundleScene;
using test::BundleSceneOptions;
using Workspace = Allocated<BundleWorkspace>;

constexpr int kSeeds = 100;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

struct Errors {
  std::vector<double> turn_deg;       // of second_from_first
  std::vector<double> direction_deg;  // of its translation
  std::vector<double> scale_percent;
  std::vector<double> tilt_deg;  // of the table
  std::vector<double> table_mm;  // under the dish
  std::vector<double> centre_mm;
  double camera_nees = 0.0;  // normalised error squared of both cameras, mean over scenes; expected: 12
  double table_nees = 0.0;   // of the table under the dish; expected: 1
  double place_nees = 0.0;   // of the dish's centre; expected: 2
  double card_nees = 0.0;    // of its lie; expected: 3
  int failures = 0;

  void print(const char* what) const {
    std::printf(
        "%-30s turn %.4f deg, direction %.4f deg, scale %.4f %%, table %.4f deg %.3f mm, centre %.3f mm; "
        "NEES "
        "cameras %.2f / 12, table %.2f / 1, centre %.2f / 2, card %.2f / 3; failed %d\n",
        what, median(turn_deg), median(direction_deg), median(scale_percent), median(tilt_deg),
        median(table_mm), median(centre_mm), camera_nees, table_nees, place_nees, card_nees, failures);
  }
};

// Derivatives of the height of z = 0 under a place by a step of the camera.
Vec6 table_by_camera(const Pose& camera, const Vec2& place_mm) {
  const Vec3 up = camera.rotation.col(2);
  const Vec3 turned = camera.rotation * Vec3(place_mm.x(), place_mm.y(), 0.0);
  Vec6 derivative;
  derivative << -turned.cross(up), -up;
  return -derivative;
}

void add_scene(const BundleScene& scene, const BundleResult& result, Errors& errors) {
  const TableCameras& found = result.camera_from_table;
  const TableCameras& truth = scene.camera_from_table;
  const Pose found_motion = second_from_first(found);
  const Pose true_motion = second_from_first(truth);
  errors.turn_deg.push_back(test::rotation_error_deg(found_motion, true_motion));
  errors.direction_deg.push_back(test::direction_error_deg(found_motion, true_motion));
  errors.scale_percent.push_back(
      100.0 * std::abs(found_motion.translation.norm() / true_motion.translation.norm() - 1.0));
  errors.tilt_deg.push_back(test::table_tilt_deg(found[0], truth[0]));
  const Vec2 place = scene.place.centre_mm;
  const double table = test::table_error_mm(found[0], truth[0], place);
  errors.table_mm.push_back(std::abs(table));
  const Vec2 centre = result.dishes[0].placed.place.centre_mm - place;
  errors.centre_mm.push_back(centre.norm());

  Eigen::Matrix<double, 12, 1> cameras;
  cameras << test::pose_error(found[0], truth[0]), test::pose_error(found[1], truth[1]);
  const CamerasMatrix covariance = result.covariance.topLeftCorner<12, 12>();
  errors.camera_nees += cameras.dot(inverse_information<12>(covariance) * cameras) / kSeeds;
  const Vec6 slope = table_by_camera(found[0], place);
  errors.table_nees += table * table / slope.dot(covariance.topLeftCorner<6, 6>() * slope) / kSeeds;
  const Eigen::Matrix2d of_centre = result.dishes[0].placed.covariance.topLeftCorner<2, 2>();
  errors.place_nees += centre.dot(inverse_information<2>(of_centre) * centre) / kSeeds;
  Vec3 lie;
  lie << result.card.tilt_rad - scene.card.tilt_rad, result.card.raised_mm - scene.card.raised_mm;
  const Mat3 of_lie = result.covariance.bottomRightCorner<3, 3>();
  errors.card_nees += lie.dot(inverse_information<3>(of_lie) * lie) / kSeeds;
}

Errors run(const BundleSceneOptions& options, const BundleParams& params = {}) {
  Workspace workspace(std::size_t{1024}, std::size_t{512});
  Errors errors;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    BundleScene scene = test::bundle_scene(seed, options);
    BundleResult result;
    const Status status = adjust_bundle(scene.input(), params, *workspace, result);
    const bool is_placed = !params.use_rims || result.dishes[0].status.ok();
    if (!status.ok() || !is_placed) {
      ++errors.failures;
      std::printf("seed %llu: %s / %s\n", static_cast<unsigned long long>(seed), name(status.code()),
                  name(result.dishes[0].status.code()));
      continue;
    }
    add_scene(scene, result, errors);
  }
  return errors;
}

TEST(BundleAdjustment, ErrorsAreThoseItStates) {
  const Errors errors = run({});
  errors.print("as stated");
  EXPECT_EQ(errors.failures, 0);
  // The mean of 100 values of chi squared with n degrees of freedom has deviation sqrt(2 n / 100); weights
  // that fall off with the residual make the covariance a sixth too large.
  EXPECT_NEAR(errors.camera_nees, 11.0, 2.0);
  EXPECT_NEAR(errors.table_nees, 0.95, 0.45);
  EXPECT_NEAR(errors.place_nees, 1.9, 0.6);
  EXPECT_NEAR(errors.card_nees, 2.9, 0.75);
}

TEST(BundleAdjustment, EachTermHelps) {
  BundleParams params;
  const Errors all = run({}, params);
  params.use_rims = false;
  const Errors no_rim = run({}, params);
  no_rim.print("no rim");
  params.use_table = false;
  const Errors no_table = run({}, params);
  no_table.print("no rim, no table");
  params.use_tracks = false;
  const Errors card = run({}, params);
  card.print("card alone");
  EXPECT_LT(median(all.tilt_deg), 0.5 * median(no_table.tilt_deg));
  EXPECT_LT(median(no_rim.tilt_deg), 0.5 * median(no_table.tilt_deg));
  EXPECT_LT(median(no_table.turn_deg), 0.5 * median(card.turn_deg));
  EXPECT_LT(median(no_table.direction_deg), 0.5 * median(card.direction_deg));
}

TEST(BundleAdjustment, OutliersDoNoHarm) {
  const Errors clean = run({});
  BundleSceneOptions options;
  options.outlier_fraction = 0.35;
  options.outline_occluded_fraction = 0.2;
  const Errors errors = run(options);
  errors.print("a third outliers");
  EXPECT_EQ(errors.failures, 0);
  EXPECT_LT(median(errors.turn_deg), 1.5 * median(clean.turn_deg));
  EXPECT_LT(median(errors.tilt_deg), 1.5 * median(clean.tilt_deg));
  EXPECT_LT(median(errors.table_mm), 1.5 * median(clean.table_mm));
  EXPECT_NEAR(errors.camera_nees, 11.0, 3.0);
}

// The card lies on the tray, most of the background is the table below or things upon it.
TEST(BundleAdjustment, WhatIsNotTheTableDoesNotBendIt) {
  const Errors clean = run({});
  BundleSceneOptions options;
  options.is_on_tray = true;
  options.raised_fraction = 0.2;
  const Errors errors = run(options);
  errors.print("table below the tray, napkin");
  options.is_on_tray = false;
  options.lowered_fraction = 0.4;
  options.raised_fraction = 0.1;
  const Errors mixed = run(options);
  mixed.print("half of it on other levels");
  EXPECT_EQ(errors.failures, 0);
  EXPECT_LT(median(errors.tilt_deg), 2.0 * median(clean.tilt_deg));
  EXPECT_LT(median(errors.table_mm), 2.0 * median(clean.table_mm));
  const auto far_off = [](double error_mm) { return error_mm > 0.5; };
  EXPECT_LE(std::count_if(errors.table_mm.begin(), errors.table_mm.end(), far_off), 2);
}

// A tray pushed under a still camera: the static table, most of the tracks, is the wrong majority.
TEST(BundleAdjustment, AMovedBackgroundDoesNotVote) {
  BundleSceneOptions options;
  options.table_moved_mm = {6.0, -4.0, 0.0};
  options.table_tracks = 400;
  options.dish_tracks = 120;
  const Errors errors = run(options);
  errors.print("moved background");
  BundleSceneOptions without = options;
  without.table_tracks = 0;
  const Errors alone = run(without);
  alone.print("no background");
  EXPECT_EQ(errors.failures, 0);
  EXPECT_LT(median(errors.turn_deg), 1.5 * median(alone.turn_deg));
  EXPECT_LT(median(errors.table_mm), 1.5 * median(alone.table_mm));
}

TEST(BundleAdjustment, ADishThatMovedAgainstTheCardIsRefused) {
  int refused = 0;
  Workspace workspace(std::size_t{1024}, std::size_t{512});
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    BundleScene scene = test::bundle_scene(seed, {});
    const BundleScene other = test::bundle_scene(seed + 1000, {});
    Random random(seed);
    // The dish's tracks move 5 mm, in any direction along the table.
    const double angle = test::uniform(random, 0.0, 6.28);
    const Vec3 shift(5.0 * std::cos(angle), 5.0 * std::sin(angle), 0.0);
    for (PointTrack& track : scene.tracks) {
      if (track.label != 2) continue;
      const Vec3 in_second = scene.camera_from_table[1].rotation * shift;
      track.second += (in_second.head<2>() - in_second.z() * track.second) / 500.0;
    }
    BundleResult result;
    const Status status = adjust_bundle(scene.input(), {}, *workspace, result);
    refused += status.code() == StatusCode::pose_contradicts_card ? 1 : 0;
  }
  // Where the shift runs along the epipolar lines it only looks like another height.
  EXPECT_GE(refused, 15);
}

TEST(BundleAdjustment, NoisierTracksThanStatedWidenTheCovariance) {
  BundleSceneOptions options;
  options.track_error_factor = 2.5;
  const Errors errors = run(options);
  errors.print("tracks 2.5 times worse");
  EXPECT_EQ(errors.failures, 0);
  EXPECT_LT(errors.camera_nees, 18.0);
}

TEST(BundleAdjustment, PlacesAnOvalDish) {
  BundleSceneOptions options;
  options.dish = test::oval_plate();
  Workspace workspace(std::size_t{1024}, std::size_t{512});
  std::vector<double> azimuth_deg;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    BundleScene scene = test::bundle_scene(seed, options);
    scene.candidates = {test::dinner_plate(), test::oval_plate()};
    BundleResult result;
    ASSERT_TRUE(adjust_bundle(scene.input(), {}, *workspace, result).ok()) << "seed " << seed;
    ASSERT_TRUE(result.dishes[0].status.ok()) << "seed " << seed;
    EXPECT_EQ(result.dishes[0].placed.candidate, 1);
    azimuth_deg.push_back(
        std::abs(std::remainder(result.dishes[0].placed.place.azimuth_rad - scene.place.azimuth_rad,
                                std::numbers::pi) *
                 test::kDegrees));
  }
  EXPECT_LT(median(azimuth_deg), 0.1);
}

// Derivatives of both residuals of a track by both cameras against differences.
TEST(TrackResiduals, DerivativesAreTheNumericOnes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    BundleSceneOptions options;
    options.track_sigma_px = 1.0;
    const BundleScene scene = test::bundle_scene(seed, options);
    const TrackResiduals residuals(scene.camera_from_table, test::kFocalPx);
    const PairByCameras chain = residuals.by_cameras();
    for (int i = 0; i < 40; ++i) {
      const PointTrack& track = scene.tracks[static_cast<std::size_t>(i)];
      double off = 0.0;
      double along = 0.0;
      double by_height = 0.0;
      Vec6 by_motion;
      PairVector by_pair;
      ASSERT_TRUE(residuals.off_line(track, off, by_motion));
      ASSERT_TRUE(residuals.along_line(track, along, by_pair, by_height));
      const Eigen::Matrix<double, 12, 1> off_slope = chain.topRows<6>().transpose() * by_motion;
      const Eigen::Matrix<double, 12, 1> along_slope = chain.transpose() * by_pair;
      for (int k = 0; k < 12; ++k) {
        const double h = k % 6 < 3 ? 1e-7 : 1e-4;
        std::array<double, 2> off_at{};
        std::array<double, 2> along_at{};
        for (std::size_t side = 0; side < 2; ++side) {
          TableCameras cameras = scene.camera_from_table;
          Pose& camera = cameras[k < 6 ? 0 : 1];
          camera = moved(camera, Vec6::Unit(k % 6) * (side == 0 ? -h : h));
          const TrackResiduals there(cameras, test::kFocalPx);
          ASSERT_TRUE(there.off_line(track, off_at[side]));
          ASSERT_TRUE(there.along_line(track, along_at[side]));
        }
        const double unit = k % 6 < 3 ? test::kFocalPx : test::kFocalPx / 500.0;
        EXPECT_NEAR((off_at[1] - off_at[0]) / (2.0 * h), off_slope[k], 1e-4 * unit) << seed << ' ' << k;
        // The line's own turn, left out: the distance off the line over that to the epipole.
        EXPECT_NEAR((along_at[1] - along_at[0]) / (2.0 * h), along_slope[k], 0.02 * unit) << seed << ' ' << k;
      }
    }
  }
}

TEST(BundleAdjustment, SurvivesNonsense) {
  Workspace workspace(std::size_t{1024}, std::size_t{512});
  BundleScene scene = test::bundle_scene(3, {});
  BundleResult result;
  BundleInput input = scene.input();
  input.cards[0].camera_from_table.translation.x() = std::nan("");
  EXPECT_EQ(adjust_bundle(input, {}, *workspace, result).code(), StatusCode::card_not_found);
  input = scene.input();
  input.cards[1].information.setZero();
  EXPECT_EQ(adjust_bundle(input, {}, *workspace, result).code(), StatusCode::card_not_found);
  input = scene.input();
  input.tracks = {};
  input.dishes = {};
  EXPECT_TRUE(adjust_bundle(input, {}, *workspace, result).ok());
  EXPECT_EQ(result.lines.count, 0);
  input = scene.input();
  input.cards[1] = input.cards[0];  // no base
  const Status status = adjust_bundle(input, {}, *workspace, result);
  EXPECT_TRUE(!status.ok() || result.covariance.allFinite());
}

}  // namespace
}  // namespace traygauge
