// Rows and columns against points in space, for epipoles anywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/paper/rectification/polar_rectification.hpp"
#include "tests/core/paper/rectification_fixture.hpp"

namespace traygauge::paper {
namespace {

constexpr double kTight_px = 1e-6;

class RandomMotion : public testing::TestWithParam<EpipolePlace> {
 protected:
  static constexpr int kPairs = 8;

  void build(std::uint64_t seed) {
    Random random(seed);
    pair_ = random_pair(random, GetParam());
    ASSERT_TRUE(pair_.build(rectification_, workspace_, params_).ok());
  }
  // In the dish of that view, and not where the epipole masks.
  bool is_usable(int view, const Vec2& pixel) const {
    return pair_.region(view).is_set(pixel) &&
           (pixel - pair_.epipole(view)).norm() > params_.min_epipole_distance_px + 1.0;
  }
  // A full turn ends on the row on which it begins.
  double row_difference(double a, double b) const {
    const double turn = rectification_.rows() - 1.0;
    return std::min(std::abs(a - b), std::abs(std::abs(a - b) - turn));
  }

  const RectificationParams params_{.max_rows = 1536};  // the dishes are larger than the estimator's
  OwnedWorkspace workspace_{params_};
  Pair pair_;
  PolarRectification rectification_;
};

TEST_P(RandomMotion, PointsInSpaceShareTheirRowAndComeBackToTheirPixels) {
  int points = 0;
  for (std::uint64_t seed = 1; seed <= kPairs; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    ASSERT_NO_FATAL_FAILURE(build(seed));
    Random random(100 + seed);
    for (int i = 0; i < 400; ++i) {
      const Vec3 point(uniform(random, -110.0, 110.0), uniform(random, -110.0, 110.0),
                       uniform(random, 0.0, 50.0));
      if (!is_usable(0, pair_.first.project(point)) || !is_usable(1, pair_.second.project(point))) continue;
      std::array<Vec2, 2> at;
      for (int view = 0; view < 2; ++view) {
        const Vec2 pixel = pair_.camera(view).project(point);
        Vec2& there = at[static_cast<std::size_t>(view)];
        ASSERT_TRUE(rectification_.rectified(view, pixel, there));
        EXPECT_GE(there.minCoeff(), 0.0);
        EXPECT_LE(there.x(), rectification_.columns(view) - 1);
        EXPECT_LE(there.y(), rectification_.rows() - 1);
        EXPECT_LE((rectification_.pixel(view, there.x(), there.y()) - pixel).norm(), kTight_px);
      }
      EXPECT_LE(row_difference(at[0].y(), at[1].y()), kTight_px);
      ++points;
    }
  }
  EXPECT_GT(points, 100 * kPairs);
}

TEST_P(RandomMotion, SurfacesKeepTheirOrderAlongARow) {
  int pairs = 0;
  for (std::uint64_t seed = 1; seed <= kPairs; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    ASSERT_NO_FATAL_FAILURE(build(seed));
    EXPECT_FALSE(rectification_.mirrored());
    const SyntheticScene bare_dish;
    for (int row = 0; row < rectification_.rows(); row += 7) {
      double previous = -1e9;
      for (int column = 0; column < rectification_.columns(0); column += 5) {
        Vec3 point;
        Vec2 there;
        const Vec2 pixel = rectification_.pixel_in_row(0, column, row);
        if (!is_usable(0, pixel) || !surface_point(bare_dish, pair_.first, pixel, point)) continue;
        if (!is_usable(1, pair_.second.project(point))) continue;
        ASSERT_TRUE(rectification_.rectified(1, pair_.second.project(point), there));
        EXPECT_LE(row_difference(there.y(), row), kTight_px);
        EXPECT_GT(there.x(), previous);
        previous = there.x();
        ++pairs;
      }
    }
  }
  EXPECT_GT(pairs, 1000 * kPairs);
}

TEST_P(RandomMotion, NoDishPixelIsCompressed) {
  constexpr double kStep_px = 0.01;
  double least_row = 1e9;
  double most_row = 0.0;  // with far epipoles
  double least_column = 1e9;
  for (std::uint64_t seed = 1; seed <= kPairs; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    ASSERT_NO_FATAL_FAILURE(build(seed));
    Random random(200 + seed);
    for (int i = 0; i < 2000; ++i) {
      const int view = static_cast<int>(random.below(2));
      const Vec2 pixel(uniform(random, 0.0, 639.0), uniform(random, 0.0, 559.0));
      if (!is_usable(view, pixel)) continue;
      Vec2 at, right, below;
      if (!rectification_.rectified(view, pixel, at)) continue;
      if (!rectification_.rectified(view, pixel + kStep_px * Vec2::UnitX(), right)) continue;
      if (!rectification_.rectified(view, pixel + kStep_px * Vec2::UnitY(), below)) continue;
      if (std::max(std::abs(right.y() - at.y()), std::abs(below.y() - at.y())) > 1.0) continue;  // the seam
      const Vec2 column_gradient((right.x() - at.x()) / kStep_px, (below.x() - at.x()) / kStep_px);
      const Vec2 row_gradient((right.y() - at.y()) / kStep_px, (below.y() - at.y()) / kStep_px);
      const double scale = rectification_.pixels_per_sample();
      least_row = std::min(least_row, row_gradient.norm() * scale);
      least_column = std::min(least_column, column_gradient.norm() * scale);
      if (GetParam() >= EpipolePlace::very_far) most_row = std::max(most_row, row_gradient.norm());
    }
  }
  EXPECT_GE(least_row, 0.98);
  EXPECT_LE(most_row, 1.6);
  EXPECT_GE(least_column, 0.98);
  EXPECT_LE(least_column, 1.02);
}

TEST_P(RandomMotion, TablesAgreeWithTheClosedForm) {
  ASSERT_NO_FATAL_FAILURE(build(3));
  for (int view = 0; view < 2; ++view) {
    for (int row = 0; row < rectification_.rows(); row += 11) {
      for (const double column : {0.0, 17.25, 200.0}) {
        EXPECT_LE(
            (rectification_.pixel(view, column, row) - rectification_.pixel_in_row(view, column, row)).norm(),
            kTight_px);
      }
    }
  }
}

std::string place_name(const testing::TestParamInfo<EpipolePlace>& place) {
  constexpr std::array kNames = {"Inside", "Border", "Outside", "VeryFar", "Infinity"};
  return kNames[static_cast<std::size_t>(place.param)];
}

INSTANTIATE_TEST_SUITE_P(EpipoleAt, RandomMotion,
                         testing::Values(EpipolePlace::inside, EpipolePlace::border, EpipolePlace::outside,
                                         EpipolePlace::very_far, EpipolePlace::infinity),
                         place_name);

// A pair whose epipole in the first view lies `distance_px` away, on either side; 0 stands for infinity.
Pair pair_with_epipole_at(double distance_px) {
  Pair pair;
  pair.first = look_at({40.0, -150.0, 440.0}, Vec3::Zero(), 0.3, 1000.0, 640, 560);
  Vec3 heading(0.8, 0.6, 0.0);
  if (distance_px != 0.0) heading.z() = pair.first.pinhole.fx_px / distance_px;
  const Pose sideways{Mat3(Eigen::AngleAxisd(0.2, Vec3(0.1, 0.9, 0.2).normalized())), Vec3::Zero()};
  pair.second = pair.first;
  pair.second.camera_from_world.rotation = sideways.rotation * pair.first.camera_from_world.rotation;
  const Vec3 centre =
      pair.first.centre() + 120.0 * pair.first.camera_from_world.rotation.transpose() * heading;
  pair.second.camera_from_world.translation = -(pair.second.camera_from_world.rotation * centre);
  pair.look();
  return pair;
}

TEST(EpipoleToInfinity, PixelMapsConvergeFromBothSides) {
  const RectificationParams params;
  OwnedWorkspace workspace(params);
  OwnedWorkspace limit_workspace(params);
  const Pair limit_pair = pair_with_epipole_at(0.0);
  PolarRectification limit;
  ASSERT_TRUE(limit_pair.build(limit, limit_workspace, params).ok());
  for (double distance_px = 1e4; distance_px < 2e12; distance_px *= 10.0) {
    for (const double side : {-1.0, 1.0}) {
      Pair pair = pair_with_epipole_at(side * distance_px);
      pair.first_region = limit_pair.first_region;  // only the epipole changes
      pair.second_region = limit_pair.second_region;
      PolarRectification rectification;
      ASSERT_TRUE(pair.build(rectification, workspace, params).ok());
      EXPECT_NEAR(rectification.rows(), limit.rows(), 1.0 + 3e5 / distance_px);
      double worst = 0.0;
      for (int view = 0; view < 2; ++view) {
        for (double row = 0.5; row < limit.rows() - 1; row += 13.0) {
          for (double column = 0.0; column < limit.columns(view); column += 50.0) {
            const Vec2 difference = rectification.pixel(view, column, row) - limit.pixel(view, column, row);
            worst = std::max(worst, difference.norm());
          }
        }
      }
      // A dish of 500 px: offsets grow by 500² / distance, and rows by as much.
      EXPECT_LE(worst, 1e6 / distance_px + 1e-8) << "epipole at " << side * distance_px;
    }
  }
}

TEST(ColumnOrigin, FollowsASmoothArcOfEqualDistance) {
  const RectificationParams params;
  OwnedWorkspace workspace(params);
  for (const double distance_px : {3e3, -2e4, 0.0}) {
    PolarRectification rectification;
    ASSERT_TRUE(pair_with_epipole_at(distance_px).build(rectification, workspace, params).ok());
    for (int view = 0; view < 2; ++view) {
      for (int row = 1; row + 1 < rectification.rows(); ++row) {
        const Vec2 bend = rectification.line(view, row - 1).origin -
                          2.0 * rectification.line(view, row).origin +
                          rectification.line(view, row + 1).origin;
        EXPECT_LE(bend.norm(), 0.01);
      }
    }
  }
}

}  // namespace
}  // namespace traygauge::paper
