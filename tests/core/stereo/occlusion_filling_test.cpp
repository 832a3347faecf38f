// What fills the gaps of rows whose every value is known.
#include "core/stereo/occlusion_filling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/core/stereo/disparity_row.hpp"

namespace traygauge {
namespace {

using test::kNone;
using test::px;
using GapRow = test::DisparityRow;
using Labels = std::vector<std::uint8_t>;

class StraightOutline final : public ViewSlope {
 public:
  explicit StraightOutline(double lean) : lean_(lean) {}
  double at(int, int) const override { return lean_; }

 private:
  double lean_;
};

// From straight above unless told; what the other view shows of the row is not known unless told.
struct Sight {
  Labels other_labels;
  int sign = 1;
  CameraOverRow camera{2.0, 100.0};
  CameraOverRow other_camera{2.0, 100.0};
  double outline_lean = 0.0;
};

GapRow fill(const Labels& labels, GapRow row, const OcclusionParams& params = {}, const Sight& sight = {}) {
  fill_occlusions({labels, sight.other_labels, sight.sign, sight.camera, sight.other_camera},
                  StraightOutline(sight.outline_lean), params, row);
  return row;
}

TEST(FillGaps, TheDishGoesOnBehindWhatHidesIt) {
  const Labels labels{2, 2, 1, 1, 1, 1, 3, 3};
  EXPECT_EQ(fill(labels, {px(20), px(20), kNone, kNone, kNone, px(2), px(30), px(30)}),
            (GapRow{px(20), px(20), px(2), px(2), px(2), px(2), px(30), px(30)}));
  EXPECT_EQ(fill(labels, {px(9), px(20), kNone, kNone, kNone, kNone, px(30), px(30)}),
            (GapRow{px(9), px(20), px(20), px(20), px(20), px(20), px(30), px(30)}))
      << "between two items, the lower";
}

TEST(FillGaps, TheDishKeepsItsOneKnownSide) {
  const Labels labels{0, 1, 1, 1, 1, 0};
  EXPECT_EQ(fill(labels, {kNone, kNone, kNone, px(5), kNone, kNone}),
            (GapRow{kNone, px(5), px(5), px(5), px(5), kNone}));
}

TEST(FillGaps, AnItemsOneSurfaceGoesStraightOn) {
  const Labels labels(6, 2);
  EXPECT_EQ(fill(labels, {px(20), kNone, kNone, kNone, kNone, px(22.5)}),
            (GapRow{px(20), px(20.5), px(21), px(21.5), px(22), px(22.5)}));
  EXPECT_EQ(fill(labels, {px(-20), kNone, kNone, kNone, kNone, px(-22.5)}),
            (GapRow{px(-20), px(-20.5), px(-21), px(-21.5), px(-22), px(-22.5)}));
  EXPECT_EQ(fill(labels, {px(22.5), px(20), kNone, kNone, kNone, px(22)}),
            (GapRow{px(22.5), px(20), px(20.5), px(21), px(21.5), px(22)}))
      << "from the nearest known ones";
}

// The line from 20 px to 40 px is 24, 28, 32, 36. Where neither end hides the gap from the other view.
TEST(FillGaps, AStepThatNothingHidesLiesBelowTheLine) {
  const Labels labels(6, 2);
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    OcclusionParams params;
    params.step_fraction = share;
    const GapRow up = fill(labels, {px(20), kNone, kNone, kNone, kNone, px(40)}, params);
    Sight second;
    second.sign = -1;
    const GapRow down = fill(labels, {px(40), kNone, kNone, kNone, kNone, px(20)}, params, second);
    for (std::size_t i = 1; i < 5; ++i) {
      EXPECT_EQ(up[i], px(20.0 + share * 4.0 * static_cast<double>(i))) << share;
      EXPECT_EQ(down[i], up[5 - i]) << share;
    }
  }
  const GapRow usual = fill(labels, {px(20), kNone, kNone, kNone, kNone, px(40)});
  EXPECT_EQ(usual[1], px(22));
  EXPECT_EQ(usual[4], px(28));
}

// A block of 20 px with upright walls, whose right one the second view does not see: its line of sight past
// the upper edge ends 20 columns on. The first view's leans in by `in`, so that the wall takes
// 20 in / (in + out) of them; what is left is floor.
TEST(FillGaps, OfWhatABlockHidesItsWallAndTheFloorBehindItAreTold) {
  constexpr double kHeightColumns = 1000.0;
  constexpr int kEdge = 10;
  for (const int sign : {1, -1}) {
    for (const double in : {-0.2, 0.0, 0.1, 0.3, 0.9}) {
      constexpr double kOut = 0.3;
      const Labels labels(40, 2);
      GapRow row(40, px(30));
      for (std::size_t x = kEdge + 1; x < 40; ++x) row[x] = x <= kEdge + 20 ? kNone : px(10);
      Sight sight;
      sight.sign = sign;
      const double edge = sign > 0 ? kEdge + 1 : 39 - kEdge - 1;
      sight.camera = {edge + sign * in * kHeightColumns, kHeightColumns};
      sight.other_camera = {edge - sign * kOut * kHeightColumns, kHeightColumns};
      if (sign < 0) std::reverse(row.begin(), row.end());
      GapRow filled = fill(labels, row, {}, sight);
      if (sign < 0) std::reverse(filled.begin(), filled.end());
      const double wall = std::max(21.0 * std::max(in, 0.0) / (kOut + std::max(in, 0.0)), 1.0);
      for (std::size_t i = 1; i <= 20; ++i) {
        const double expected_px = 30.0 - 20.0 * std::min(static_cast<double>(i) / wall, 1.0);
        EXPECT_NEAR(filled[kEdge + i], px(expected_px), 1) << i << " of a view that leans in by " << in;
      }
    }
  }
}

// 30 samples wide and 10 disparities deep: 20 of them both views see.
TEST(FillGaps, WhatBothViewsSeeOfAGapAndDidNotMatchIsPartlySlope) {
  constexpr int kEdge = 5;
  const Labels labels(45, 2);
  Sight sight;
  sight.camera = {6.0, 1000.0};
  sight.other_camera = {-300.0, 1000.0};
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    for (const int gap : {8, 10, 11, 14, 30}) {
      OcclusionParams params;
      params.unmatched_fall_fraction = share;
      GapRow row(45, px(10));
      std::fill_n(row.begin(), kEdge + 1, px(20));
      std::fill_n(row.begin() + kEdge + 1, gap, kNone);
      const GapRow filled = fill(labels, row, params, sight);
      const double slope = std::max(share * (gap - 10), 1.0);
      for (int i = 1; i <= gap; ++i) {
        EXPECT_NEAR(filled[static_cast<std::size_t>(kEdge + i)], px(20.0 - 10.0 * std::min(i / slope, 1.0)),
                    1)
            << i << " of " << gap << " samples, " << share;
      }
    }
  }
}

TEST(FillGaps, OneSurfaceOrTwoIsDecidedByTheirDifference) {
  const Labels labels{2, 2, 2};
  OcclusionParams params;
  params.same_surface_px = 4.0;
  EXPECT_EQ(fill(labels, {px(10), kNone, px(14)}, params)[1], px(12));
  EXPECT_EQ(fill(labels, {px(10), kNone, px(14.125)}, params)[1], px(11));
  const Labels dish{1, 1, 1};
  EXPECT_EQ(fill(dish, {px(10), kNone, px(14)}, params)[1], px(12));
  EXPECT_EQ(fill(dish, {px(10), kNone, px(14.125)}, params)[1], px(10));
}

// Known up to column 0 or 5, the outline at column 5 or 0.
TEST(FillGaps, HiddenFlanksFallTowardsTheOutline) {
  OcclusionParams params;
  params.contact_fraction = params.limb_fraction = 0.5;
  const GapRow right{px(20), px(18), px(16), px(14), px(12), px(3)};
  EXPECT_EQ(fill({2, 2, 2, 2, 2, 1}, {px(20), kNone, kNone, kNone, kNone, px(3)}, params), right);
  EXPECT_EQ(fill({1, 2, 2, 2, 2, 2}, {px(3), kNone, kNone, kNone, kNone, px(20)}, params),
            GapRow(right.rbegin(), right.rend()));
  EXPECT_EQ(fill({2, 2, 2, 2, 2, 3}, {px(20), kNone, kNone, kNone, kNone, px(90)}, params)[4], px(12))
      << "another item is an outline too";
  EXPECT_EQ(fill({2, 2, 2, 2, 2}, {px(20), kNone, kNone, kNone, kNone}, params)[4], px(12))
      << "and so is the picture's edge";
  EXPECT_EQ(fill({2, 2, 2, 2, 2, 1}, {px(20), kNone, kNone, kNone, kNone, px(3)})[4],
            px(20) - px(20) * 85 / 100 * 4 / 5)
      << "to 0.15 of its height";
}

// A camera 100 columns up. Flanks have a run of 0.2 ± 0.1: it sees their foot while it stands less than 10
// columns on the other side of the outline, and a limb from 30 on; in between, something of both.
TEST(FillGaps, FlanksEndOnTheDishWhereTheViewSeesTheirFoot) {
  OcclusionParams params;
  params.contact_fraction = 0.0;
  params.limb_fraction = 1.0;
  params.flank_run = 0.2;
  params.lean_spread = 0.1;
  const auto last_of = [&](double foot_column, bool on_right) {
    Sight sight;
    sight.camera.foot_column = foot_column;
    return on_right ? fill({2, 2, 2, 2, 1}, {px(20), kNone, kNone, kNone, px(3)}, params, sight)[3]
                    : fill({1, 2, 2, 2, 2}, {px(3), kNone, kNone, kNone, px(20)}, params, sight)[1];
  };
  for (const double foot_column : {1000.0, 4.0, -5.0}) {
    EXPECT_EQ(last_of(foot_column, true), px(5))
        << "the outline lies at 4, the foot of the camera at " << foot_column;
    EXPECT_EQ(last_of(4.0 - foot_column, false), px(5)) << "mirrored";
  }
  for (const double foot_column : {-27.0, -1000.0}) {
    EXPECT_EQ(last_of(foot_column, true), px(20)) << foot_column;
    EXPECT_EQ(last_of(4.0 - foot_column, false), px(20)) << "mirrored";
  }
  EXPECT_EQ(last_of(-16.0, true), px(12.5)) << "half of both";
  for (int foot_column = -30; foot_column < 10; ++foot_column) {
    EXPECT_GE(last_of(foot_column, true), last_of(foot_column + 1, true)) << foot_column;
  }
}

// Below the plane of disparity 0 there is nothing to fall to.
TEST(FillGaps, FlanksBelowTheDishDoNotRise) {
  EXPECT_EQ(fill({2, 2, 2, 1}, {px(-6), kNone, kNone, px(-9)}), (GapRow{px(-6), px(-6), px(-6), px(-9)}));
}

TEST(FillGaps, NothingKnownLeavesNothing) {
  EXPECT_EQ(fill({2, 2, 2, 0, 2, 1, 3}, {kNone, kNone, kNone, px(4), kNone, px(3), kNone}),
            (GapRow{kNone, kNone, kNone, px(4), kNone, px(3), kNone}));
  EXPECT_EQ(fill({1, 0, 1}, {px(4), kNone, kNone}), (GapRow{px(4), kNone, kNone}));
}

// An item on columns 10 to 19 of the first view, 20 px high up to column 13, and on columns to `other_end` of
// the second: at column 19 it is at most other_end − 19 high.
GapRow fill_within_hull(int sign, int other_end, double outline_lean, const OcclusionParams& params = {}) {
  constexpr int kWidth = 60;
  Labels labels(kWidth, 1);
  Labels other_labels(kWidth, 1);
  GapRow row(kWidth, px(0));
  for (std::size_t x = 10; x < 20; ++x) {
    labels[x] = 2;
    row[x] = x <= 13 ? px(20) : kNone;
  }
  for (int x = 15; x <= other_end; ++x) other_labels[static_cast<std::size_t>(x)] = 2;
  Sight sight;
  sight.sign = sign;
  sight.outline_lean = outline_lean;
  if (sign < 0) {
    std::reverse(labels.begin(), labels.end());
    std::reverse(other_labels.begin(), other_labels.end());
    std::reverse(row.begin(), row.end());
  }
  sight.other_labels = other_labels;
  GapRow filled = fill(labels, row, params, sight);
  if (sign < 0) std::reverse(filled.begin(), filled.end());
  return filled;
}

TEST(FillGaps, AnOutlineIsNoHigherThanTheOtherViewsOutlineAllows) {
  for (const int sign : {1, -1}) {
    for (int other_end = 33; other_end <= 42; ++other_end) {
      const GapRow filled = fill_within_hull(sign, other_end, 1.0);
      EXPECT_NEAR(filled[19], px(std::min(other_end - 19.0, 20.0)), 1) << other_end << ", sign " << sign;
      for (std::size_t x = 14; x < 20; ++x) {
        EXPECT_LE(filled[x], filled[x - 1]) << x;
        EXPECT_LE(filled[x], px(other_end - static_cast<double>(x) + 0.5))
            << x << ", other end " << other_end;
      }
    }
  }
}

TEST(FillGaps, AWallSeenFromOutsideReachesFurtherDown) {
  const OcclusionParams params;
  int above = px(20) + 1;
  for (int percent = 20; percent >= -30; --percent) {
    const GapRow filled = fill_within_hull(1, 35, 0.01 * percent);
    EXPECT_LE(filled[19], above) << percent;
    above = filled[19];
  }
  EXPECT_EQ(fill_within_hull(1, 35, 1.0)[19], px(16));
  EXPECT_EQ(fill_within_hull(1, 35, -1.0)[19], static_cast<int>(16.0 * params.seen_wall_fraction * 16.0));
  EXPECT_EQ(fill_within_hull(1, 20, -1.0), fill_within_hull(1, 20, 1.0))
      << "where the known sample's partner is not on the item the outline says nothing";
}

// In the other view the item goes on for three columns beside the last known sample's partner: it is level as
// far as both see it, and falls beyond.
TEST(FillGaps, WhatBothViewsSeeBesideAnEdgeStaysUp) {
  OcclusionParams params;
  params.other_outline_fraction = 1.0;
  const GapRow filled = fill_within_hull(1, 36, -1.0, params);
  for (const std::size_t x : {14U, 15U, 16U}) EXPECT_EQ(filled[x], px(20)) << x;
  for (const std::size_t x : {17U, 18U, 19U}) EXPECT_LT(filled[x], filled[x - 1]) << x;
}

// Whatever the labels and the known samples: every sample with a label and a known one of its own gets a
// disparity between those of the row, and nothing that was known changes.
TEST(FillGaps, RandomRowsStayWithinWhatIsKnown) {
  constexpr unsigned kSeed = 47;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  const auto below = [&](unsigned end) { return static_cast<int>(random() % end); };
  for (int round = 0; round < 2000; ++round) {
    const std::size_t width = 1U + random() % 60U;
    Labels labels(width);
    Sight sight;
    sight.other_labels.resize(width);
    GapRow row(width);
    int label = 0;
    int other_label = 0;
    for (std::size_t x = 0; x < width; ++x) {
      if (below(8) == 0) label = below(4);
      if (below(8) == 0) other_label = below(4);
      labels[x] = static_cast<std::uint8_t>(label);
      sight.other_labels[x] = static_cast<std::uint8_t>(other_label);
      row[x] = below(3) == 0 ? static_cast<Disparity>(below(900) - 100) : kNone;
    }
    sight.sign = below(2) == 0 ? 1 : -1;
    sight.camera.foot_column = below(400) - 200;
    sight.other_camera.foot_column = below(400) - 200;
    sight.outline_lean = 0.01 * below(100) - 0.5;
    const GapRow filled = fill(labels, row, {}, sight);
    int least = 0;  // flanks fall towards the dish
    int most = -100;
    for (const Disparity d : row) {
      if (d == kNone) continue;
      least = std::min<int>(least, d);
      most = std::max<int>(most, d);
    }
    for (std::size_t x = 0; x < width; ++x) {
      if (row[x] != kNone || labels[x] == 0) {
        EXPECT_EQ(filled[x], row[x]) << "round " << round << ", column " << x;
      } else if (filled[x] != kNone) {
        EXPECT_GE(filled[x], least) << "round " << round << ", column " << x;
        EXPECT_LE(filled[x], most) << "round " << round << ", column " << x;
      }
    }
  }
}

}  // namespace
}  // namespace traygauge
