// What is filled in where no view sees: holes against OpenCV's distance transform, flanks against bounds.
#include "core/volume/occluded_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

constexpr int kFillSide = 90;
constexpr double kFillCellMm = 0.8;
constexpr double kFillBottomMm = 2.0;
constexpr std::uint8_t kFillItem = 4;

struct FillMap {
  InnerSurface dish;
  std::vector<HeightCell> cells{std::size_t{kFillSide} * kFillSide};
  std::vector<HeightMapWorkspace::Source> sources{std::size_t{kFillSide} * kFillSide};
  HeightMap map;

  explicit FillMap(bool has_profile = true) {
    DishModel model;
    model.outer_size_mm = {400.0, 300.0};
    model.rim_height_mm = model.bottom_height_mm = kFillBottomMm;
    if (has_profile) {
      model.profile_points[0].height_mm = kFillBottomMm;  // level from its edge on
      model.profile_points[1] = {1.0, kFillBottomMm};
      model.profile_size = 2;
    }
    EXPECT_TRUE(dish.profile.set(model).ok());
    map.cells = {cells.data(), kFillSide, kFillSide};
    map.cell_mm = kFillCellMm;
    map.origin_mm = Vec2::Constant(-0.5 * kFillCellMm * (kFillSide - 1));
    for (HeightCell& cell : cells) {
      cell = {.z_mm = static_cast<float>(kFillBottomMm),
              .label = kDishLabel,
              .kind = CellKind::surface,
              .weight = 200};
    }
  }
  HeightCell& at(int x, int y) { return map.cells.at(x, y); }
  void fill(const HeightMapParams& params, double steepest_sight = 3.0) {
    fill_occluded_cells(dish, params, steepest_sight, sources, map);
  }
};

// Every known cell has a height of its own, so that a filled one tells where it took it from.
TEST(OccludedCells, FillHolesFromTheNearestWithinReach) {
  std::mt19937 random(test::random_seed());
  std::uniform_int_distribution<int> place(0, kFillSide - 1);
  std::uniform_int_distribution<int> radius(2, 14);
  HeightMapParams params;
  params.max_hole_mm = 6.0;
  int filled = 0;
  int beyond = 0;
  int not_nearest = 0;
  for (int round = 0; round < 20; ++round) {
    FillMap scene;
    cv::Mat1b known(kFillSide, kFillSide, std::uint8_t{255});
    for (int i = 0; i < 6; ++i)
      cv::circle(known, {place(random), place(random)}, radius(random), cv::Scalar(0), cv::FILLED);
    for (int y = 0; y < kFillSide; ++y) {
      for (int x = 0; x < kFillSide; ++x) {
        HeightCell& cell = scene.at(x, y);
        cell.z_mm = static_cast<float>(10 + y * kFillSide + x);
        cell.label = kFillItem;
        if (known(y, x) == 0) cell = {};
      }
    }
    cv::Mat1f nearest;
    cv::distanceTransform(known == 0, nearest, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    scene.fill(params);
    const double reach = params.max_hole_mm / kFillCellMm;
    for (int y = 0; y < kFillSide; ++y) {
      for (int x = 0; x < kFillSide; ++x) {
        const HeightCell& cell = scene.at(x, y);
        if (known(y, x) != 0) {
          ASSERT_EQ(cell.kind, CellKind::surface);
          ASSERT_EQ(cell.z_mm, static_cast<float>(10 + y * kFillSide + x));
          continue;
        }
        const double least = static_cast<double>(nearest(y, x));
        if (least > reach + 1e-3) {
          ASSERT_EQ(cell.kind, CellKind::unseen);
          ++beyond;
          continue;
        }
        if (cell.kind == CellKind::unseen) {  // a source that is a fraction of a cell worse
          EXPECT_GT(least, reach - 0.5);
          continue;
        }
        const int from = static_cast<int>(cell.z_mm) - 10;
        const double distance = std::hypot(x - from % kFillSide, y - from / kFillSide);
        EXPECT_LT(distance, least + 0.5);
        not_nearest += distance > least + 1e-3 ? 1 : 0;
        ++filled;
        EXPECT_EQ(cell.label, kFillItem);
        EXPECT_EQ(cell.kind, CellKind::hidden);
      }
    }
  }
  EXPECT_GT(filled, 3000);
  EXPECT_GT(beyond, 100);
  EXPECT_LT(not_nearest, 0.02 * filled);
}

// A block of `height_mm` at the left; right of its edge lines of sight come down to the dish with `sight`.
FillMap with_shadow(double height_mm, double sight) {
  FillMap scene;
  constexpr int kEdge = 30;
  for (int y = 0; y < kFillSide; ++y) {
    for (int x = 0; x < kFillSide; ++x) {
      HeightCell& cell = scene.at(x, y);
      const double bound_mm = kFillBottomMm + height_mm - sight * kFillCellMm * (x - kEdge);
      if (x <= kEdge) {
        cell.z_mm = static_cast<float>(kFillBottomMm + height_mm);
        cell.label = kFillItem;
      } else if (bound_mm > kFillBottomMm) {
        cell = {.z_mm = static_cast<float>(bound_mm),
                .below_mm = static_cast<float>(kFillBottomMm),
                .label = kFillItem,
                .below_label = kDishLabel,
                .kind = CellKind::hidden};
      }
    }
  }
  return scene;
}

TEST(OccludedCells, FlanksStayBetweenDishAndLineOfSightAndFallAwayFromTheEdge) {
  for (const double sight : {1.5, 3.0}) {
    const FillMap before = with_shadow(30.0, sight);
    FillMap scene = with_shadow(30.0, sight);
    scene.fill({}, sight);
    int hidden = 0;
    for (int y = 0; y < kFillSide; ++y) {
      float last = 1e9F;
      for (int x = 0; x < kFillSide; ++x) {
        const HeightCell& cell = scene.at(x, y);
        EXPECT_LE(cell.z_mm, before.map.cells.at(x, y).z_mm);
        EXPECT_GE(cell.z_mm, static_cast<float>(kFillBottomMm));
        EXPECT_LE(cell.z_mm, last);
        last = cell.z_mm;
        EXPECT_EQ(cell.label, cell.z_mm > static_cast<float>(kFillBottomMm) ? kFillItem : kDishLabel);
        hidden += cell.kind == CellKind::hidden ? 1 : 0;
      }
    }
    EXPECT_GT(hidden, 500);
  }
}

// The filled section ends up between a wall and the whole wedge below the line of sight.
TEST(OccludedCells, ASteeperFlankHidesLess) {
  double last_mm2 = 1e9;
  for (const double steepness : {0.5, 1.0, 2.0, 4.0, 1000.0}) {
    FillMap scene = with_shadow(30.0, 1.5);
    HeightMapParams params;
    params.hidden_steepness = steepness;
    scene.fill(params, 1.5);
    double section_mm2 = 0.0;
    for (int x = 0; x < kFillSide; ++x) {
      const HeightCell& cell = scene.at(x, kFillSide / 2);
      if (cell.kind == CellKind::hidden)
        section_mm2 += kFillCellMm * (static_cast<double>(cell.z_mm) - kFillBottomMm);
    }
    EXPECT_LT(section_mm2, last_mm2) << steepness;
    last_mm2 = section_mm2;
  }
  EXPECT_LT(last_mm2, 0.05 * 0.5 * 30.0 * 30.0 / 1.5);
}

TEST(OccludedCells, BehindWhatIsNoItemTheFootGoesOnLevel) {
  FillMap scene;
  for (int y = 20; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) {
      // Above the dish another item, seen at the foot of the line of sight, and a bound by the dish's rim.
      scene.at(x, y) = {.z_mm = 12.0F,
                        .below_mm = x < 30 ? 9.0F : 15.0F,
                        .label = kDishLabel,
                        .below_label = kFillItem,
                        .kind = CellKind::hidden};
    }
  }
  scene.fill({});
  EXPECT_FLOAT_EQ(scene.at(25, 30).z_mm, 9.0F);
  EXPECT_EQ(scene.at(25, 30).label, kFillItem);
  EXPECT_FLOAT_EQ(scene.at(35, 30).z_mm, 12.0F);  // never over the line of sight
}

// On a board holes lie beside the flanks of what stands there, and what is nearest is no guess at them.
TEST(OccludedCells, ADishWithoutAProfileKeepsItsHoles) {
  FillMap scene(false);
  for (int y = 20; y < 24; ++y) {
    for (int x = 30; x < 34; ++x) scene.at(x, y) = {};
  }
  scene.fill({});
  EXPECT_EQ(scene.at(31, 21).kind, CellKind::unseen);
}

TEST(OccludedCells, NothingKnownStaysUnseen) {
  FillMap scene;
  std::fill(scene.cells.begin(), scene.cells.end(), HeightCell{});
  scene.fill({});
  for (const HeightCell& cell : scene.cells) ASSERT_EQ(cell.kind, CellKind::unseen);
}

}  // namespace
}  // namespace traygauge
