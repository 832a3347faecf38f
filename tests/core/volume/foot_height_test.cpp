// Items on a dish, ray cast into grids, whose heights are then wrong by as much as a motion makes them.
#include "core/volume/foot_height.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/core/stereo/solid_scene.hpp"

namespace traygauge {
namespace {

constexpr std::uint8_t kFootItem = 2;
constexpr double kFootSamples = 40'000.0;  // of the dish in each view

class FootHeights : public ::testing::Test {
 protected:
  // Both views of an item, matched everywhere, which is lifted by so much.
  std::array<test::TrueGrid, 2> look_at(const test::Solid& item, float lifted_mm) {
    test::SolidScene scene;
    scene.dish = dish_;
    scene.solids = {item};
    std::array<test::TrueGrid, 2> grids = {test::cast_grid(scene, {480.0, 10.0, 0.0}, {}, kFootSamples),
                                           test::cast_grid(scene, {480.0, 20.0, 120.0}, {}, kFootSamples)};
    for (test::TrueGrid& grid : grids) {
      for (std::size_t i = 0; i < grid.count(); ++i) {
        grid.evidence[i] = SurfaceEvidence::both;
        if (grid.labels[i] == kFootItem) grid.points[i].z_mm += lifted_mm;
      }
    }
    return grids;
  }
  std::optional<double> foot(const std::array<test::TrueGrid, 2>& grids) const {
    return foot_height_mm({grids[0].view(), grids[1].view()}, dish_, kFootItem);
  }

  InnerSurface dish_ = test::dinner_plate();
  test::Solid heap_ = test::cap(kFootItem, {190.0, -105.0}, 35.0, 4.5, 20.0);
};

TEST_F(FootHeights, AreNearTheDishUnderAHeap) {
  const std::optional<double> height_mm = foot(look_at(heap_, 0.0F));
  ASSERT_TRUE(height_mm.has_value());
  EXPECT_GT(*height_mm, -0.2);
  EXPECT_LT(*height_mm, 4.0);
}

TEST_F(FootHeights, FallAsTheItemDoes) {
  const double still_mm = foot(look_at(heap_, 0.0F)).value();
  for (const float lifted_mm : {-8.0F, -3.0F, -1.0F, 2.0F})
    EXPECT_NEAR(foot(look_at(heap_, lifted_mm)).value(), still_mm + lifted_mm, 0.26) << lifted_mm;
}

TEST_F(FootHeights, ComeFromTheViewThatHasTheLowerOne) {
  std::array<test::TrueGrid, 2> grids = look_at(heap_, 0.0F);
  grids[1] = look_at(heap_, -5.0F)[1];
  EXPECT_LT(foot(grids).value(), -2.0);
}

TEST_F(FootHeights, OfWhatWasNotMatchedAreNotKnown) {
  std::array<test::TrueGrid, 2> grids = look_at(heap_, 0.0F);
  for (test::TrueGrid& grid : grids)
    std::fill(grid.evidence.begin(), grid.evidence.end(), SurfaceEvidence::filled);
  EXPECT_FALSE(foot(grids).has_value());
}

}  // namespace
}  // namespace traygauge
