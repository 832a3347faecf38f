// Round bodies from their outlines, against solids ray cast from two cameras: what is matched on them lies
// too low, as shine does.
#include "core/volume/round_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "tests/core/stereo/solid_scene.hpp"
#include "tests/support/allocated.hpp"

namespace traygauge {
namespace {

using test::SolidScene;
using test::TrueGrid;

constexpr int kFood = 2;
constexpr int kSide = 150;  // samples, 1 mm apart on the dish's bottom

struct Eyes {
  double height_mm = 450.0;
  double baseline_mm = 120.0;
  double aside_mm = 60.0;  // of their middle from the body, along the rows
  double back_mm = 120.0;  // and across them
};

// Both views over the same rows, which are parallel to the baseline.
struct TwoGrids {
  std::array<TrueGrid, 2> grids{TrueGrid(kSide, kSide), TrueGrid(kSide, kSide)};
  std::array<TrueGrid, 2> truth{grids};

  TwoGrids(const SolidScene& scene, const Eyes& eyes) {
    const double level_mm = scene.dish.profile.bottom_height_mm();
    for (std::size_t v = 0; v < 2; ++v) {
      TrueGrid& grid = truth[v];
      const double along_mm = eyes.aside_mm + (v == 0 ? 0.5 : -0.5) * eyes.baseline_mm;
      grid.camera_mm = Vec3(along_mm, eyes.back_mm, level_mm + eyes.height_mm);
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          // What stands on the bottom is seen further out, away from the camera.
          const Vec2 shift = -0.05 * grid.camera_mm.head<2>();
          const Vec3 foot(x - 0.5 * kSide + shift.x(), y - 0.5 * kSide + shift.y(), level_mm);
          const SolidScene::Hit hit = scene.cast(grid.camera_mm, (foot - grid.camera_mm).normalized());
          const std::size_t at = grid.index(x, y);
          const Eigen::Vector3f point = hit.point_mm.cast<float>();
          grid.points[at] = {point.x(), point.y(), point.z()};
          grid.labels[at] = static_cast<std::uint8_t>(hit.label);
          grid.evidence[at] = SurfaceEvidence::both;
        }
      }
    }
    grids = truth;
  }

  // Moves the food's points down along their lines of sight to a share of their height.
  void lower(double share, const SolidScene& scene) {
    const double level_mm = scene.dish.profile.bottom_height_mm();
    for (TrueGrid& grid : grids) {
      for (std::size_t at = 0; at < grid.count(); ++at) {
        if (!is_item(grid.labels[at])) continue;
        SurfacePoint& point = grid.points[at];
        const Vec3 sight = Vec3(point.x_mm, point.y_mm, point.z_mm) - grid.camera_mm;
        const double z_mm = level_mm + share * (static_cast<double>(point.z_mm) - level_mm);
        const Vec3 lowered = grid.camera_mm + (grid.camera_mm.z() - z_mm) / -sight.z() * sight;
        point = {static_cast<float>(lowered.x()), static_cast<float>(lowered.y()), static_cast<float>(z_mm)};
      }
    }
  }
  void forget() {
    for (TrueGrid& grid : grids)
      std::fill(grid.evidence.begin(), grid.evidence.end(), SurfaceEvidence::filled);
  }

  // Where the food's outline is near in a row or column.
  void forget_rim(int reach) {
    for (TrueGrid& grid : grids) {
      for (int y = reach; y + reach < kSide; ++y) {
        for (int x = reach; x + reach < kSide; ++x) {
          const auto is_food = [&](int dx, int dy) {
            return grid.labels[grid.index(x + dx, y + dy)] == kFood;
          };
          if (!is_food(reach, 0) || !is_food(-reach, 0) || !is_food(0, reach) || !is_food(0, -reach))
            grid.evidence[grid.index(x, y)] = SurfaceEvidence::filled;
        }
      }
    }
  }

  LabelSet shape(const SolidScene& scene) {
    test::Allocated<RoundBodyWorkspace> workspace(kSide, kSide);
    return shape_round_bodies({{grids[0].view(), grids[1].view()}, {grids[0].points, grids[1].points}},
                              scene.dish, {}, *workspace);
  }
  bool is_shaped(const SolidScene& scene) { return shape(scene).contains(kFood); }

  // Mean and median height error of both views over the greatest height.
  void errors(double height_mm, double& mean, double& median) const {
    std::vector<double> off;
    mean = 0.0;
    for (std::size_t v = 0; v < 2; ++v) {
      for (std::size_t at = 0; at < grids[v].count(); ++at) {
        if (grids[v].labels[at] != kFood) continue;
        const double error =
            static_cast<double>(grids[v].points[at].z_mm - truth[v].points[at].z_mm) / height_mm;
        mean += error;
        off.push_back(std::abs(error));
      }
    }
    mean /= static_cast<double>(off.size());
    std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
    median = off[off.size() / 2];
  }
};

SolidScene on_plate(test::Solid solid) {
  SolidScene scene;
  scene.dish = test::dinner_plate();
  scene.dish.place.centre_mm = Vec2::Zero();
  scene.solids.push_back(std::move(solid));
  return scene;
}

double bottom_mm() {
  return test::dinner_plate().profile.bottom_height_mm();
}

SolidScene with_ellipsoid(const Vec3& semi_axes, double turn_rad) {
  return on_plate(test::ellipsoid(kFood, {0.0, 0.0, bottom_mm() + semi_axes.z()}, semi_axes, turn_rad));
}

TEST(RoundBody, StandsAsHighAsItsOutlinesSay) {
  constexpr unsigned kSeed = 31;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  const auto draw = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  double sum = 0.0;
  constexpr int kBodies = 10;
  for (int i = 0; i < kBodies; ++i) {
    const double half_width = draw(16.0, 30.0);
    const Vec3 semi_axes(half_width * draw(1.0, 1.5), half_width, half_width * draw(0.8, 1.0));
    const double turn_rad = draw(0.0, M_PI);
    const SolidScene scene = with_ellipsoid(semi_axes, turn_rad);
    const Eyes eyes{draw(400.0, 520.0), draw(60.0, 160.0), draw(-120.0, 120.0), draw(-140.0, 140.0)};
    TwoGrids grids(scene, eyes);
    grids.lower(0.75, scene);
    if (i % 2 == 1) grids.forget();
    ASSERT_TRUE(grids.is_shaped(scene)) << i;
    double mean = 0.0;
    double median = 0.0;
    grids.errors(2.0 * semi_axes.z(), mean, median);
    std::printf("half axes %.0f %.0f %.0f mm, baseline %3.0f mm: mean %+.3f, median %.3f of the height\n",
                semi_axes.x(), semi_axes.y(), semi_axes.z(), eyes.baseline_mm, mean, median);
    EXPECT_LT(median, 0.05);
    EXPECT_LT(std::abs(mean), 0.05);
    sum += mean;
  }
  EXPECT_LT(std::abs(sum / kBodies), 0.025);
}

// What is matched where it truly is stays there.
TEST(RoundBody, KeepsWhatWasMatchedOnIt) {
  const SolidScene scene = with_ellipsoid({34.0, 26.0, 23.0}, 0.4);
  TwoGrids grids(scene, {});
  ASSERT_TRUE(grids.is_shaped(scene));
  double mean = 0.0;
  double median = 0.0;
  grids.errors(46.0, mean, median);
  EXPECT_LT(median, 0.01);
}

TEST(RoundBody, LeavesOtherFoodAlone) {
  const Vec2 middle = Vec2::Zero();
  const double bottom = bottom_mm();
  const std::vector<test::Solid> solids = {
      test::box(kFood, middle, {26.0, 20.0}, 0.5, bottom + 36.0),
      test::box(kFood, middle, {30.0, 30.0}, 0.1, bottom + 16.0),
      test::cylinder(kFood, middle, 24.0, bottom + 30.0),
      test::cap(kFood, middle, 30.0, bottom, 22.0),
      test::cone(kFood, middle, 32.0, bottom, 30.0),
      test::heap(kFood, middle, {36.0, 30.0}, bottom, 26.0, 3.0, 12.0, 5),
  };
  for (const test::Solid& solid : solids) {
    const SolidScene scene = on_plate(solid);
    TwoGrids grids(scene, {});
    EXPECT_FALSE(grids.is_shaped(scene)) << solid.name;
    double mean = 0.0;
    double median = 0.0;
    grids.errors(1.0, mean, median);
    EXPECT_EQ(median, 0.0);
    EXPECT_EQ(mean, 0.0);
  }
}

// Its outlines are as high and as wide as a fruit's, and walls are matched badly, but not its top.
TEST(RoundBody, LeavesSlicesOfCakeAlone) {
  constexpr unsigned kSeed = 5;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 12; ++i) {
    const double turn_rad = 2.0 * M_PI * unit(random);
    const Vec2 tip = -45.0 * Vec2(std::cos(turn_rad), std::sin(turn_rad));
    const SolidScene scene = on_plate(test::wedge(kFood, tip, 75.0 + 10.0 * unit(random),
                                                  0.6 + 0.3 * unit(random), turn_rad, bottom_mm() + 36.0));
    TwoGrids grids(scene, {});
    grids.forget_rim(6);
    EXPECT_FALSE(grids.is_shaped(scene)) << i;
  }
}

TEST(RoundBody, IsOnePiece) {
  SolidScene scene = with_ellipsoid({26.0, 26.0, 24.0}, 0.0);
  EXPECT_TRUE(TwoGrids(scene, {}).is_shaped(scene));
  scene.solids.push_back(test::ellipsoid(kFood, {44.0, 30.0, bottom_mm() + 10.0}, {10.0, 10.0, 10.0}, 0.0));
  EXPECT_FALSE(TwoGrids(scene, {}).is_shaped(scene));
}

// Its outline lies on the bowl's wall, as high as a fruit's limb.
TEST(RoundBody, LeavesLiquidsAlone) {
  SolidScene scene;
  scene.dish = test::soup_bowl();
  scene.dish.place.centre_mm = Vec2::Zero();
  scene.solids.push_back(test::liquid(kFood, scene.dish, scene.dish.profile.bottom_height_mm() + 20.0));
  TwoGrids grids(scene, {});
  grids.forget();
  EXPECT_FALSE(grids.is_shaped(scene));
}

TEST(RoundBody, NeedsItsWholeOutline) {
  SolidScene scene = with_ellipsoid({26.0, 26.0, 24.0}, 0.0);
  TwoGrids free(scene, {});
  EXPECT_TRUE(free.is_shaped(scene));
  scene.solids.push_back(test::box(3, {-40.0, 0.0}, {18.0, 30.0}, 0.0, bottom_mm() + 20.0));
  TwoGrids beside(scene, {});
  EXPECT_FALSE(beside.is_shaped(scene));
}

TEST(RoundBody, IsNotSeenFromTheSide) {
  const SolidScene scene = with_ellipsoid({26.0, 26.0, 24.0}, 0.0);
  TwoGrids grids(scene, {.height_mm = 300.0, .back_mm = 280.0});
  EXPECT_FALSE(grids.is_shaped(scene));
}

}  // namespace
}  // namespace traygauge
