// What the views agree on, on rows whose every value is known.
#include "core/stereo/consistency.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <vector>

#include "tests/core/stereo/disparity_row.hpp"

namespace traygauge {
namespace {

constexpr int kSamples = 20;
using test::kNone;
using test::px;
using Row = test::DisparityRow;

Row keep(const Row& own, const Row& other, int sign) {
  const auto width = static_cast<int>(own.size());
  Row kept(own.size());
  keep_consistent({own.data(), width, 1}, {other.data(), width, 1}, sign, {kept.data(), width, 1});
  return kept;
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

TEST(KeepConsistent, ToleratesOneAndAHalfPixelsAndNoMore) {
  const Row first(kSamples, px(4));
  for (const int sign : {1, -1}) {
    const std::size_t middle = kSamples / 2;
    for (const double off_px : {1.5, -1.5})
      EXPECT_EQ(keep(first, Row(kSamples, px(4.0 + off_px)), sign)[middle], px(4)) << off_px;
    for (const double off_px : {1.5625, -1.5625})
      EXPECT_EQ(keep(first, Row(kSamples, px(4.0 + off_px)), sign)[middle], kNone) << off_px;
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

}  // namespace
}  // namespace traygauge
