// The edge of a dish that nothing is known of, in closed form.
#include "core/enrolment/dish_edge.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/core/dish/edge_outlines.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

using test::camera_at;
using test::outline_of;

class UnknownDish : public ::testing::Test {
 protected:
  Status measure() {
    return measure_dish_edge({rays_[0], rays_[1]}, cameras_, {test::kOutlineFocalPx, test::kOutlineFocalPx},
                             {}, {}, *workspace_, place_);
  }
  void show(const DishPose& place, int points = 300) {
    for (std::size_t view = 0; view < 2; ++view) rays_[view] = outline_of(place, cameras_[view], points);
  }

  TableCameras cameras_ = test::two_cameras();
  std::array<std::vector<Vec2>, 2> rays_;
  test::Allocated<DishPoseWorkspace> workspace_{std::size_t{1024}};
  DishPose place_;
};

TEST_F(UnknownDish, SizeAndHeightFollowFromBothOutlines) {
  std::mt19937 random(test::random_seed());
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 50; ++i) {
    const double size = draw(90.0, 320.0);
    const DishPose truth{{draw(-30.0, 30.0), draw(-30.0, 30.0)},
                         draw(-1.5, 1.5),
                         draw(8.0, 110.0),
                         {size, i % 2 == 0 ? size : size * draw(0.6, 0.95)},
                         draw(0.0, 3.0)};
    show(truth);
    ASSERT_TRUE(measure().ok()) << i;
    EXPECT_LT((place_.centre_mm - truth.centre_mm).norm(), 0.3) << i;
    EXPECT_NEAR(place_.edge_height_mm, truth.edge_height_mm, 0.6) << i;
    // The order of the axes is not given.
    const auto [low, high] = std::minmax(place_.size_mm[0], place_.size_mm[1]);
    EXPECT_NEAR(low, std::min(truth.size_mm[0], truth.size_mm[1]), 0.5) << i;
    EXPECT_NEAR(high, std::max(truth.size_mm[0], truth.size_mm[1]), 0.5) << i;
  }
}

TEST_F(UnknownDish, OutlinesOfTwoDishesContradictEachOther) {
  show({{0.0, 0.0}, 0.0, 22.0, {260.0, 260.0}, 1.0});
  rays_[1] = outline_of({{0.0, 0.0}, 0.0, 22.0, {200.0, 200.0}, 1.0}, cameras_[1]);
  EXPECT_EQ(measure().code(), StatusCode::labels_inconsistent);
}

TEST_F(UnknownDish, OneViewDoesNotTellAHeight) {
  show({{0.0, 0.0}, 0.0, 22.0, {260.0, 260.0}, 1.0});
  rays_[1].clear();
  EXPECT_EQ(measure().code(), StatusCode::rim_not_found);
}

TEST_F(UnknownDish, AFewRaysAreNoOutline) {
  show({{0.0, 0.0}, 0.0, 22.0, {260.0, 260.0}, 1.0}, 16);
  EXPECT_EQ(measure().code(), StatusCode::rim_not_found);
}

}  // namespace
}  // namespace traygauge
