// Rendered scenes with exact depth: partners lie in the same row, and look alike there.
#include <gtest/gtest.h>

#include "core/paper/rectification/polar_rectification.hpp"
#include "tests/core/paper/photometric.hpp"
#include "tests/core/paper/rectification_fixture.hpp"

namespace traygauge::paper {
namespace {

struct Case {
  const char* name;
  SolidShape shape;
  Vec3 second_position;
  double second_roll;
};

class RenderedScene : public testing::TestWithParam<Case> {};

TEST_P(RenderedScene, TruePartnersLookAlikeInTheirRow) {
  const SyntheticScene scene{.shape = GetParam().shape, .radius_mm = 40.0, .centre_mm = {10.0, -5.0}};
  Pair pair;
  pair.first = look_at({-70.0, -40.0, 430.0}, {0.0, 0.0, 10.0}, 0.1, 700.0, 420, 400);
  pair.second =
      look_at(GetParam().second_position, {0.0, 0.0, 10.0}, GetParam().second_roll, 700.0, 420, 400);
  pair.look();
  const RenderedView first = render(scene, pair.first, 2);
  const RenderedView second = render(scene, pair.second, 2);
  const RectificationParams params;
  OwnedWorkspace workspace(params);
  PolarRectification rectification;
  ASSERT_TRUE(pair.build(rectification, workspace, params).ok());
  const auto pictures = rectify_both(rectification, first.gray_view(), second.gray_view());

  const auto partner = [&](const Vec2& pixel) -> std::optional<Vec2> {
    Vec3 point;
    if (!pair.first_region.is_set(pixel) || !surface_point(scene, pair.first, pixel, point)) return {};
    if (!is_visible(scene, pair.second, point)) return {};
    return pair.second.project(point);
  };
  const RowAgreement agreement = compare_rows(rectification, pictures[0], pictures[1], partner);
  EXPECT_GT(agreement.pixels, 40000);
  EXPECT_LE(agreement.worst_row_px, 1e-6);
  EXPECT_LE(agreement.difference[1], 5.0);
  EXPECT_GE(agreement.difference[0], 2.0 * agreement.difference[1]);
  EXPECT_GE(agreement.difference[2], 2.0 * agreement.difference[1]);
  EXPECT_NEAR(agreement.offset_px(), 0.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, RenderedScene,
    testing::Values(Case{"HemisphereSideways", SolidShape::hemisphere, {80.0, -30.0, 430.0}, 0.1},
                    Case{"ConeRolled", SolidShape::cone, {60.0, 60.0, 430.0}, 1.2},
                    Case{"BoxForward", SolidShape::box, {-50.0, -30.0, 340.0}, 0.2},
                    Case{"HeightFieldUpsideDown", SolidShape::height_field, {30.0, -120.0, 410.0}, 3.0}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });

// The generator itself: its closed forms against its own height map, integrated.
TEST(SyntheticScene, VolumeDepthAndLabelsFollowFromTheHeight) {
  for (const SolidShape shape : {SolidShape::none, SolidShape::cone, SolidShape::hemisphere, SolidShape::box,
                                 SolidShape::height_field}) {
    const SyntheticScene scene{.shape = shape, .radius_mm = 40.0, .centre_mm = {10.0, -5.0}};
    constexpr double kStep_mm = 0.25;
    double sum_mm3 = 0.0;
    for (double y = -60.0 + 0.5 * kStep_mm; y < 60.0; y += kStep_mm) {
      for (double x = -60.0 + 0.5 * kStep_mm; x < 60.0; x += kStep_mm) {
        sum_mm3 += scene.height({x, y}) * kStep_mm * kStep_mm;
      }
    }
    EXPECT_NEAR(sum_mm3 / 1000.0, scene.volume_ml(), 2e-3 * scene.volume_ml());
    const SyntheticCamera camera = look_at({-70.0, -140.0, 430.0}, Vec3::Zero(), 0.4, 300.0, 200, 180);
    const RenderedView view = render(scene, camera, 1);
    for (int y = 1; y < 179; y += 3) {
      for (int x = 1; x < 199; x += 3) {
        const Vec3 point = camera.centre() + view.depth(x, y) * camera.direction(Vec2(x, y));
        EXPECT_LE((camera.project(point) - Vec2(x, y)).norm(), 1e-9);
        const bool on_wall = shape == SolidShape::box && point.z() > 1e-6 && point.z() < 30.0 - 1e-6;
        EXPECT_TRUE(on_wall || std::abs(point.z() - scene.height(point.head<2>())) <= 1e-6);
        EXPECT_EQ(view.label_view().at(x, y),
                  point.z() > 1e-6 ? 2 : (point.head<2>().norm() <= 130.0 ? 1 : 0));
        EXPECT_TRUE(is_visible(scene, camera, point));
      }
    }
  }
}

}  // namespace
}  // namespace traygauge::paper
