// Horizontal order: surfaces seen from the same side keep it, a sheet seen from both sides inverts it.
#include <gtest/gtest.h>

#include "core/paper/rectification/polar_rectification.hpp"
#include "tests/core/paper/rectification_fixture.hpp"

namespace traygauge::paper {
namespace {

class Mirroring : public testing::Test {
 protected:
  void SetUp() override {
    pair_.first = look_at({-200.0, 10.0, 420.0}, Vec3::Zero(), 0.2, 1000.0, 640, 560);
    pair_.second = look_at({200.0, -30.0, 410.0}, Vec3::Zero(), -0.1, 1000.0, 640, 560);
    pair_.look();
  }
  void add(const Vec3& point) {
    points_.push_back(point);
    matches_.push_back({pair_.first.pinhole.ray(pair_.first.project(point)),
                        pair_.second.pinhole.ray(pair_.second.project(point))});
  }
  // Upright, between the cameras, its trace on the dish along y.
  void add_glass_sheet(int count) {
    Random random(5);
    for (int i = 0; i < count; ++i) add({0.0, uniform(random, -40.0, 40.0), uniform(random, 0.0, 80.0)});
  }
  void add_dish(int count) {
    Random random(6);
    for (int i = 0; i < count; ++i) add({uniform(random, -60.0, 60.0), uniform(random, -60.0, 60.0), 0.0});
  }
  void build() { ASSERT_TRUE(pair_.build(rectification_, workspace_, params_, matches_).ok()); }

  RectificationParams params_;
  OwnedWorkspace workspace_{params_};
  Pair pair_;
  std::vector<Vec3> points_;
  std::vector<RayMatch> matches_;
  PolarRectification rectification_;
};

TEST_F(Mirroring, TheDishStaysAsItIs) {
  add_dish(500);
  ASSERT_NO_FATAL_FAILURE(build());
  EXPECT_FALSE(rectification_.mirrored());
}

TEST_F(Mirroring, ASheetSeenFromBothSidesIsMirroredAndKeepsItsRows) {
  add_glass_sheet(500);
  ASSERT_NO_FATAL_FAILURE(build());
  ASSERT_TRUE(rectification_.mirrored());
  for (const Vec3& point : points_) {
    Vec2 first;
    Vec2 second;
    ASSERT_TRUE(rectification_.rectified(0, pair_.first.project(point), first));
    ASSERT_TRUE(rectification_.rectified(1, pair_.second.project(point), second));
    EXPECT_NEAR(first.y(), second.y(), 1e-6);
    EXPECT_LE((rectification_.pixel(1, second.x(), second.y()) - pair_.second.project(point)).norm(), 1e-6);
  }
  // Along each row the sheet now runs the same way in both pictures.
  for (int row = 150; row < rectification_.rows() - 150; row += 10) {
    double previous = -1e9;
    for (int column = 0; column < rectification_.columns(0); column += 4) {
      const Vec3 centre = pair_.first.centre();
      const Vec3 ray = pair_.first.direction(rectification_.pixel_in_row(0, column, row));
      const Vec3 point = centre - centre.x() / ray.x() * ray;
      Vec2 there;
      if (point.z() < 0.0 || point.z() > 80.0) continue;
      if (!rectification_.rectified(1, pair_.second.project(point), there)) continue;
      EXPECT_GT(there.x(), previous);
      previous = there.x();
    }
    EXPECT_GT(previous, 0.0);
  }
}

TEST_F(Mirroring, MirroredPicturesAreMirrorImages) {
  ASSERT_NO_FATAL_FAILURE(build());
  PolarRectification mirrored;
  OwnedWorkspace workspace(params_);
  add_glass_sheet(100);
  ASSERT_TRUE(pair_.build(mirrored, workspace, params_, matches_).ok());
  ASSERT_TRUE(mirrored.mirrored());
  const int columns = rectification_.columns(1);
  ASSERT_EQ(mirrored.columns(1), columns);
  ASSERT_EQ(mirrored.columns(0), rectification_.columns(0));
  Picture straight(columns, rectification_.rows());
  Picture reversed(columns, rectification_.rows());
  const RenderedView picture = render({}, pair_.second, 1);
  rectification_.rectify(1, picture.gray_view(), straight.view());
  mirrored.rectify(1, picture.gray_view(), reversed.view());
  int different = 0;
  for (int y = 0; y < straight.height; ++y) {
    for (int x = 0; x < columns; ++x) {
      const int a = straight.view().at(x, y);
      const int b = reversed.view().at(columns - 1 - x, y);
      different += std::abs(a - b) > 1 ? 1 : 0;
    }
  }
  EXPECT_LE(different, straight.height);  // the cut edge of the picture may round either way
}

TEST_F(Mirroring, TheMajorityOfPairsDecides) {
  add_dish(300);
  add_glass_sheet(60);
  ASSERT_NO_FATAL_FAILURE(build());
  EXPECT_FALSE(rectification_.mirrored());
  points_.clear();
  matches_.clear();
  add_dish(20);
  add_glass_sheet(300);
  ASSERT_NO_FATAL_FAILURE(build());
  EXPECT_TRUE(rectification_.mirrored());
}

TEST_F(Mirroring, MatchesOffTheDishDoNotVote) {
  for (int i = 0; i < 50; ++i) matches_.push_back({Vec2(5.0 + i, 5.0), Vec2(5.0 - i, 5.0)});
  ASSERT_NO_FATAL_FAILURE(build());
  EXPECT_FALSE(rectification_.mirrored());
}

}  // namespace
}  // namespace traygauge::paper
