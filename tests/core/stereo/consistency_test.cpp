// What the views agree on and what fills the rest, on rows whose every value is known.
#include "core/stereo/consistency.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <vector>

namespace traygauge {
namespace {

constexpr int kSamples = 20;
constexpr Disparity kNone = kNoDisparity;
using Row = std::vector<Disparity>;
using Labels = std::vector<std::uint8_t>;

constexpr Disparity px(double disparity_px) {
  return static_cast<Disparity>(disparity_px * kDisparityScale);
}

Row keep(const Row& own, const Row& other, int sign, const ConsistencyParams& params = {}) {
  const auto width = static_cast<int>(own.size());
  Row kept(own.size());
  keep_consistent({own.data(), width, 1}, {other.data(), width, 1}, sign, params, {kept.data(), width, 1});
  return kept;
}

// Seen from straight above unless told.
Row fill(const Labels& labels, Row row, const ConsistencyParams& params = {},
         const RowSight& sight = {2.0, 100.0}) {
  fill_gaps(labels, sight, params, row);
  return row;
}

TEST(KeepConsistent, DropsWhatTheSecondViewContradicts) {
  const Row first(kSamples, px(3));
  Row second(kSamples, px(3));
  second[8] = px(9);  // partner of column 5
  second[9] = kNone;  // of column 6
  const Row kept = keep(first, second, 1);
  for (std::size_t x = 0; x < kSamples; ++x)
    EXPECT_EQ(kept[x], x == 5 || x == 6 || x >= 17 ? kNone : px(3)) << x;
}

TEST(KeepConsistent, DropsWhatTheFirstViewContradicts) {
  Row first(kSamples, px(3));
  const Row second(kSamples, px(3));
  first[8] = px(-3);  // partner of column 11
  first[9] = kNone;   // of column 12
  const Row kept = keep(second, first, -1);
  for (std::size_t x = 0; x < kSamples; ++x)
    EXPECT_EQ(kept[x], x == 11 || x == 12 || x < 3 ? kNone : px(3)) << x;
}

TEST(KeepConsistent, FollowsNegativeDisparities) {
  Row first(kSamples, px(-2.25));
  Row second(kSamples, px(-2.25));
  second[4] = px(5);  // partner of column 6
  first[15] = px(5);  // of the second's column 13
  const Row kept = keep(first, second, 1);
  const Row kept_second = keep(second, first, -1);
  for (std::size_t x = 0; x < kSamples; ++x) {
    EXPECT_EQ(kept[x], x == 6 || x < 2 || x == 15 ? kNone : px(-2.25)) << x;
    EXPECT_EQ(kept_second[x], x == 13 || x >= 18 || x == 4 ? kNone : px(-2.25)) << x;
  }
}

TEST(KeepConsistent, ToleratesTheGreatestDifferenceAndNoMore) {
  ConsistencyParams params;
  params.max_difference_px = 2.0;
  const Row first(kSamples, px(4));
  for (const int sign : {1, -1}) {
    const std::size_t middle = kSamples / 2;
    for (const double off_px : {2.0, -2.0})
      EXPECT_EQ(keep(first, Row(kSamples, px(4.0 + off_px)), sign, params)[middle], px(4)) << off_px;
    for (const double off_px : {2.0625, -2.0625})
      EXPECT_EQ(keep(first, Row(kSamples, px(4.0 + off_px)), sign, params)[middle], kNone) << off_px;
  }
}

// A surface that both views see, written into both, then wrong in some places of either.
TEST(KeepConsistent, KeepsRandomSurfacesWhereTheyAreRight) {
  constexpr unsigned kSeed = 31;
  constexpr int kWidth = 400;
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  Row first(kWidth, kNone);
  Row second(kWidth, kNone);
  std::vector<int> partner(kWidth, -1);
  int last = -1;
  for (int x = 0; x < kWidth; ++x) {
    const int whole = static_cast<int>(random() % 9) - 4 + x / 40;
    const int at = x + whole;
    if (at <= last || at >= kWidth) continue;
    last = at;
    const auto d = static_cast<Disparity>(whole * kDisparityScale + static_cast<int>(random() % 15) - 7);
    first[static_cast<std::size_t>(x)] = second[static_cast<std::size_t>(at)] = d;
    partner[static_cast<std::size_t>(x)] = at;
  }
  const Row truth = first;
  std::vector<bool> wrong(kWidth, false);
  for (std::size_t x = 0; x < kWidth; ++x) {
    if (partner[x] < 0 || random() % 5 != 0) continue;
    wrong[x] = true;
    second[static_cast<std::size_t>(partner[x])] = static_cast<Disparity>(truth[x] + px(8));
  }
  const Row kept = keep(first, second, 1);
  int kept_count = 0;
  for (std::size_t x = 0; x < kWidth; ++x) {
    EXPECT_EQ(kept[x], wrong[x] ? kNone : truth[x]) << x;
    kept_count += kept[x] != kNone ? 1 : 0;
  }
  EXPECT_GT(kept_count, kWidth / 5);
}

TEST(FillGaps, TheDishGoesOnBehindWhatHidesIt) {
  const Labels labels{2, 2, 1, 1, 1, 1, 3, 3};
  EXPECT_EQ(fill(labels, {px(20), px(20), kNone, kNone, kNone, px(2), px(30), px(30)}),
            (Row{px(20), px(20), px(2), px(2), px(2), px(2), px(30), px(30)}));
  EXPECT_EQ(fill(labels, {px(9), px(20), kNone, kNone, kNone, kNone, px(30), px(30)}),
            (Row{px(9), px(20), px(20), px(20), px(20), px(20), px(30), px(30)}))
      << "between two items, the lower";
}

TEST(FillGaps, TheDishKeepsItsOneKnownSide) {
  const Labels labels{0, 1, 1, 1, 1, 0};
  EXPECT_EQ(fill(labels, {kNone, kNone, kNone, px(5), kNone, kNone}),
            (Row{kNone, px(5), px(5), px(5), px(5), kNone}));
}

TEST(FillGaps, AnItemsOneSurfaceGoesStraightOn) {
  const Labels labels(6, 2);
  EXPECT_EQ(fill(labels, {px(20), kNone, kNone, kNone, kNone, px(22.5)}),
            (Row{px(20), px(20.5), px(21), px(21.5), px(22), px(22.5)}));
  EXPECT_EQ(fill(labels, {px(-20), kNone, kNone, kNone, kNone, px(-22.5)}),
            (Row{px(-20), px(-20.5), px(-21), px(-21.5), px(-22), px(-22.5)}));
  EXPECT_EQ(fill(labels, {px(22.5), px(20), kNone, kNone, kNone, px(22)}),
            (Row{px(22.5), px(20), px(20.5), px(21), px(21.5), px(22)}))
      << "from the nearest known ones";
}

// The line from 20 px to 40 px is 24, 28, 32, 36.
TEST(FillGaps, WhatAnItemHidesOfItselfLiesBelowTheLine) {
  const Labels labels(6, 2);
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    ConsistencyParams params;
    params.chord_share = share;
    const Row up = fill(labels, {px(20), kNone, kNone, kNone, kNone, px(40)}, params);
    const Row down = fill(labels, {px(40), kNone, kNone, kNone, kNone, px(20)}, params);
    for (std::size_t i = 1; i < 5; ++i) {
      EXPECT_EQ(up[i], px(20.0 + share * 4.0 * static_cast<double>(i))) << share;
      EXPECT_EQ(down[i], up[5 - i]) << share;
    }
  }
  const Row usual = fill(labels, {px(20), kNone, kNone, kNone, kNone, px(40)});
  EXPECT_EQ(usual[1], px(22));
  EXPECT_EQ(usual[4], px(28));
}

TEST(FillGaps, OneSurfaceOrTwoIsDecidedByTheirDifference) {
  const Labels labels{2, 2, 2};
  ConsistencyParams params;
  params.same_surface_px = 4.0;
  EXPECT_EQ(fill(labels, {px(10), kNone, px(14)}, params)[1], px(12));
  EXPECT_EQ(fill(labels, {px(10), kNone, px(14.125)}, params)[1], px(11) + 0);
  const Labels dish{1, 1, 1};
  EXPECT_EQ(fill(dish, {px(10), kNone, px(14)}, params)[1], px(12));
  EXPECT_EQ(fill(dish, {px(10), kNone, px(14.125)}, params)[1], px(10));
}

// Known up to column 0 or 5, the outline at column 5 or 0.
TEST(FillGaps, HiddenFlanksFallTowardsTheOutline) {
  ConsistencyParams params;
  params.contact_share = params.limb_share = 0.5;
  const Row right{px(20), px(18), px(16), px(14), px(12), px(3)};
  EXPECT_EQ(fill({2, 2, 2, 2, 2, 1}, {px(20), kNone, kNone, kNone, kNone, px(3)}, params), right);
  EXPECT_EQ(fill({1, 2, 2, 2, 2, 2}, {px(3), kNone, kNone, kNone, kNone, px(20)}, params),
            Row(right.rbegin(), right.rend()));
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
  ConsistencyParams params;
  params.contact_share = 0.0;
  params.limb_share = 1.0;
  params.flank_run = 0.2;
  params.flank_run_spread = 0.1;
  const auto last_of = [&](double foot_column, bool on_right) {
    const RowSight sight{foot_column, 100.0};
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
  for (double foot_column = -30.0; foot_column < 10.0; foot_column += 1.0) {
    EXPECT_GE(last_of(foot_column, true), last_of(foot_column + 1.0, true)) << foot_column;
  }
}

// Below the plane of disparity 0 there is nothing to fall to.
TEST(FillGaps, FlanksBelowTheDishDoNotRise) {
  EXPECT_EQ(fill({2, 2, 2, 1}, {px(-6), kNone, kNone, px(-9)}), (Row{px(-6), px(-6), px(-6), px(-9)}));
}

TEST(FillGaps, NothingKnownLeavesNothing) {
  EXPECT_EQ(fill({2, 2, 2, 0, 2, 1, 3}, {kNone, kNone, kNone, px(4), kNone, px(3), kNone}),
            (Row{kNone, kNone, kNone, px(4), kNone, px(3), kNone}));
  EXPECT_EQ(fill({1, 0, 1}, {px(4), kNone, kNone}), (Row{px(4), kNone, kNone}));
}

}  // namespace
}  // namespace traygauge
