// Caps, masks and inputs that cannot be rectified.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/paper/rectification/polar_rectification.hpp"
#include "tests/core/paper/rectification_fixture.hpp"

namespace traygauge::paper {
namespace {

// Straight towards the dish: the epipole is in the middle of both pictures.
Pair forward_pair() {
  Pair pair;
  pair.first = look_at({0.0, 0.0, 560.0}, Vec3::Zero(), 0.2, 1000.0, 640, 560);
  pair.second = look_at({0.0, 0.0, 500.0}, Vec3::Zero(), -0.4, 1000.0, 640, 560);
  pair.look();
  return pair;
}

Pair sideways_pair() {
  Pair pair;
  pair.first = look_at({-60.0, 20.0, 480.0}, Vec3::Zero(), 0.2, 1000.0, 640, 560);
  pair.second = look_at({90.0, 10.0, 480.0}, Vec3::Zero(), 0.1, 1000.0, 640, 560);
  pair.look();
  return pair;
}

StatusCode build_status(const Pair& pair, const RectificationParams& params = {}) {
  OwnedWorkspace workspace(params);
  PolarRectification rectification;
  const Status status = pair.build(rectification, workspace, params);
  EXPECT_EQ(rectification.rows() > 0, status.ok());
  return status.code();
}

TEST(Caps, AFullTurnIsReducedEvenlyToFit) {
  const Pair pair = forward_pair();
  for (const int cap : {700, 1000, 1536, 3000}) {
    const RectificationParams params{.max_rows = cap, .max_columns = 1024, .max_reduction = 3.0};
    OwnedWorkspace workspace(params);
    PolarRectification rectification;
    ASSERT_TRUE(pair.build(rectification, workspace, params).ok());
    EXPECT_LE(rectification.rows(), cap);
    EXPECT_TRUE(rectification.pixels_per_sample() == 1.0 || rectification.rows() >= 0.95 * cap);
    const Vec2 step = rectification.line(0, 0).step;
    EXPECT_NEAR(step.norm(), rectification.pixels_per_sample(), 1e-9);
    // The last row is the first one again.
    const RectifiedLine& first = rectification.line(1, 0);
    const RectifiedLine& last = rectification.line(1, rectification.rows() - 1);
    EXPECT_LE((first.origin - last.origin).norm() + (first.step - last.step).norm(), 1e-9);
  }
}

TEST(Caps, ColumnsBindToo) {
  RectificationParams params;
  params.max_columns = 300;
  OwnedWorkspace workspace(params);
  PolarRectification rectification;
  ASSERT_TRUE(sideways_pair().build(rectification, workspace, params).ok());
  EXPECT_GT(rectification.pixels_per_sample(), 1.0);
  for (int view = 0; view < 2; ++view) EXPECT_LE(rectification.columns(view), 300);
}

TEST(Caps, TooSmallOnesFail) {
  EXPECT_EQ(build_status(forward_pair(), {.max_rows = 300}), StatusCode::rectification_failed);
  EXPECT_EQ(build_status(sideways_pair(), {.max_columns = 100}), StatusCode::rectification_failed);
  EXPECT_EQ(build_status(sideways_pair(), {.max_rows = 400, .max_reduction = 1.0}),
            StatusCode::rectification_failed);
}

TEST(Mask, HidesWhatIsNearTheEpipole) {
  const Pair pair = forward_pair();
  const RectificationParams params{.max_rows = 2048, .min_epipole_distance_px = 40.0};
  OwnedWorkspace workspace(params);
  PolarRectification rectification;
  ASSERT_TRUE(pair.build(rectification, workspace, params).ok());
  Vec2 at;
  for (int view = 0; view < 2; ++view) {
    for (double around = 0.0; around < 6.3; around += 0.1) {
      const Vec2 heading(std::cos(around), std::sin(around));
      EXPECT_FALSE(rectification.rectified(view, pair.epipole(view) + 39.9 * heading, at));
      EXPECT_TRUE(rectification.rectified(view, pair.epipole(view) + 40.1 * heading, at));
    }
  }
}

TEST(Unrectifiable, CamerasThatCoincide) {
  Pair pair = sideways_pair();
  pair.motion.translation.setZero();
  EXPECT_EQ(build_status(pair), StatusCode::rectification_failed);
  pair.motion.translation.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(build_status(pair), StatusCode::rectification_failed);
}

TEST(Unrectifiable, EmptyDish) {
  Pair pair = sideways_pair();
  std::ranges::fill(pair.second_region.pixels, std::uint8_t{0});
  EXPECT_EQ(build_status(pair), StatusCode::rectification_failed);
  pair.second_region = {};
  EXPECT_EQ(build_status(pair), StatusCode::rectification_failed);
}

TEST(Unrectifiable, NoEpipolarLineCrossesBothDishes) {
  Pair pair = sideways_pair();
  for (int y = 0; y < 560; ++y) {
    for (int x = 0; x < 640; ++x) {
      pair.first_region.view().at(x, y) = y < 150 ? 1 : 0;
      pair.second_region.view().at(x, y) = y > 450 ? 1 : 0;
    }
  }
  EXPECT_EQ(build_status(pair), StatusCode::rectification_failed);
}

TEST(Unrectifiable, BadParameters) {
  EXPECT_TRUE(validate(RectificationParams{}).ok());
  EXPECT_FALSE(validate(RectificationParams{.max_rows = 1}).ok());
  EXPECT_FALSE(validate(RectificationParams{.max_reduction = 0.5}).ok());
  EXPECT_FALSE(validate(RectificationParams{.margin_px = -1.0}).ok());
  EXPECT_FALSE(validate(RectificationParams{.min_epipole_distance_px = 0.0}).ok());
  EXPECT_FALSE(validate(RectificationParams{.order_samples = 0}).ok());
}

constexpr std::size_t planned_bytes(const RectificationParams& params) {
  ArenaPlan plan;
  RectificationWorkspace workspace;
  workspace.allocate(plan, params);
  return plan.high_water_bytes();
}
static_assert(planned_bytes({.max_rows = 1024, .order_samples = 256}) == (72 * 1024 + 16 * 256));

}  // namespace
}  // namespace traygauge::paper
