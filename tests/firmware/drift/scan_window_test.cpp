#include "firmware/drift/scan_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

WindowScan scan_of(std::int64_t number, std::optional<double> scale_percent, bool counts = true) {
  return {number, 0, counts, {scale_percent}};
}

CheckSeries scales(const ScanWindow& window, std::size_t max) {
  return window.series(WatchedCheck::scale_percent, max);
}

using Values = std::vector<double>;

TEST(ScanWindow, TellsThoseAtItsEndInTheirOrder) {
  ScanWindow first(ScanWindow::End::first, 4);
  ScanWindow last(ScanWindow::End::last, 4);
  for (const int number : {3, 1, 2, 6, 5, 4}) {
    first.put(scan_of(number, 10.0 * number));
    last.put(scan_of(number, 10.0 * number));
  }
  EXPECT_EQ(scales(first, 10).values, (Values{10, 20, 30, 40}));
  EXPECT_EQ(scales(first, 2).values, (Values{10, 20}));
  EXPECT_EQ(scales(first, 2).last_number, 2);
  EXPECT_EQ(scales(last, 10).values, (Values{30, 40, 50, 60}));
  EXPECT_EQ(scales(last, 2).values, (Values{50, 60}));
  EXPECT_EQ(scales(last, 2).first_number, 5);
}

TEST(ScanWindow, PassesOverWhatDoesNotCountOrHasNoValue) {
  ScanWindow window(ScanWindow::End::last, 5);
  window.put(scan_of(1, 10.0));
  window.put(scan_of(2, std::nullopt));
  window.put(scan_of(3, 30.0, false));
  window.put(scan_of(4, 40.0));
  EXPECT_EQ(scales(window, 5).values, (Values{10, 40}));
  EXPECT_TRUE(window.series(WatchedCheck::blur_px, 5).values.empty());
  window.put(scan_of(3, 30.0));  // somebody took the correction back
  window.put(scan_of(4, 40.0, false));
  EXPECT_EQ(scales(window, 5).values, (Values{10, 30}));
}

// Whatever comes in which order, how often and how changed: the last word on each of the scans nearest to the
// end holds.
TEST(ScanWindow, HoldsWhatASortedListWouldHold) {
  std::mt19937 random(random_seed());
  for (int round = 0; round < 300; ++round) {
    const std::size_t max_scans = 1 + random() % 12;
    const std::size_t max_values = 1 + random() % 12;
    ScanWindow first(ScanWindow::End::first, max_scans);
    ScanWindow last(ScanWindow::End::last, max_scans);
    std::map<std::int64_t, WindowScan> all;
    for (int i = 0; i < 60; ++i) {
      // Mostly the next scan, sometimes one of before: a corrected one, or one that comes late.
      const auto newest = all.empty() ? 0 : all.rbegin()->first;
      const auto number = random() % 4 == 0 ? static_cast<std::int64_t>(random() % 60) : newest + 1;
      const bool has_value = random() % 4 != 0;
      const WindowScan scan =
          scan_of(number, has_value ? std::optional(0.5 * static_cast<double>(random() % 9)) : std::nullopt,
                  random() % 5 != 0);
      // What left the window is not asked for again: its place is taken by others.
      all[number] = scan;
      first.put(scan);
      last.put(scan);
    }
    const auto expected = [&](auto begin, auto end) {
      Values values;
      std::size_t looked_at = 0;
      for (auto at = begin; at != end && looked_at++ < max_scans; ++at) {
        if (at->second.counts && at->second.values[0] && values.size() < max_values)
          values.push_back(*at->second.values[0]);
      }
      return values;
    };
    ASSERT_EQ(scales(first, max_values).values, expected(all.begin(), all.end())) << "round " << round;
    Values reversed = expected(all.rbegin(), all.rend());
    std::reverse(reversed.begin(), reversed.end());
    ASSERT_EQ(scales(last, max_values).values, reversed) << "round " << round;
    ASSERT_LE(first.scans().size(), max_scans);
    ASSERT_LE(last.scans().size(), max_scans);
  }
}

}  // namespace
}  // namespace traygauge::test
