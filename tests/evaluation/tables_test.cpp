// Parts of the tables on made-up measurements: differences between rows, choice of pairs, changed pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/evaluation/tables/paired_difference.hpp"
#include "tests/evaluation/tables/paper_tables.hpp"
#include "tests/evaluation/tables/picture_change.hpp"
#include "tests/evaluation/tables/table_runner.hpp"

namespace traygauge::tables {
namespace {

// Of one capture a food for each row of `volumes`, measured by each pair; 0: refused. The truth is 100 ml.
std::vector<PairRuns> runs_with(const std::string& capture, const std::vector<std::vector<double>>& volumes) {
  std::vector<PairRuns> runs(volumes.front().size());
  for (std::size_t p = 0; p < runs.size(); ++p) {
    runs[p].capture = capture;
    runs[p].pair = {0, static_cast<int>(p) + 1};
    runs[p].runs.resize(1);
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      const int label = 2 + static_cast<int>(i);
      TruthItem item;
      item.label = label;
      item.volume_ml = 100.0;
      runs[p].truth.items.push_back(item);
      const StatusCode status = volumes[i][p] > 0.0 ? StatusCode::ok : StatusCode::item_hidden;
      runs[p].runs[0].items.push_back({label, status, volumes[i][p], 0.0, 0.0});
    }
  }
  return runs;
}

void append(std::vector<PairRuns>& runs, std::vector<PairRuns> more) {
  runs.insert(runs.end(), more.begin(), more.end());
}

TEST(PairedDifference, CountsOnlyWhatBothMeasured) {
  // The second method refuses the hard pair (+30 %) of one food, and a food altogether.
  const auto first = runs_with("m1", {{102.0, 130.0}, {140.0, 140.0}});
  const auto second = runs_with("m1", {{105.0, 0.0}, {0.0, 0.0}});
  const PairedDifference difference = compare(first, second, TruthVolume::above_dish);
  EXPECT_EQ(difference.items, 1);
  EXPECT_NEAR(difference.mape, 2.0 - 5.0, 1e-12);
  EXPECT_FALSE(difference.interval) << "one capture";
  EXPECT_EQ(compare(first, {}, TruthVolume::above_dish).items, 0);
}

TEST(PairedDifference, ComparesItemsWhereRowsHaveOtherPairs) {
  const auto first = runs_with("m1", {{102.0}});
  auto second = runs_with("m1", {{0.0, 104.0}});
  second.erase(second.begin());
  EXPECT_NEAR(compare(first, second, TruthVolume::above_dish).mape, 2.0 - 4.0, 1e-12);
}

TEST(PairedDifference, VariesOverCapturesOnly) {
  std::vector<PairRuns> first;
  std::vector<PairRuns> second;
  for (const char* capture : {"m1", "m2", "m3"}) {
    append(first, runs_with(capture, {{101.0}, {103.0}}));
    append(second, runs_with(capture, {{102.0}, {106.0}}));
  }
  const PairedDifference alike = compare(first, second, TruthVolume::above_dish);
  EXPECT_EQ(alike.items, 6);
  ASSERT_TRUE(alike.interval);
  EXPECT_NEAR(alike.interval->low, -2.0, 1e-12);
  EXPECT_NEAR(alike.interval->high, -2.0, 1e-12);
  append(first, runs_with("m4", {{110.0}}));
  append(second, runs_with("m4", {{100.0}}));
  const PairedDifference other = compare(first, second, TruthVolume::above_dish);
  ASSERT_TRUE(other.interval);
  EXPECT_LT(other.interval->low, other.mape);
  EXPECT_GT(other.interval->high, other.mape);
}

TEST(PaperTables, NameReferencesThatStandInThem) {
  for (const Table& table : paper_tables()) {
    for (const Row& row : table.rows) {
      const auto is_named = [&](const Row& other) { return other.title == row.reference; };
      if (table.command == "table-7" && row.reference.empty()) continue;  // plates share no item
      EXPECT_EQ(std::count_if(table.rows.begin(), table.rows.end(), is_named), 1)
          << table.command << ": " << row.title;
    }
  }
}

TEST(PictureChange, AddsNoiseOfTheStatedDeviationFromTheSeed) {
  Picture grey({320, 240}, PixelFormat::gray8);
  std::fill(grey.pixels.begin(), grey.pixels.end(), std::uint8_t{128});
  const PictureChange change{5.0, false};
  Picture once = grey;
  Picture again = grey;
  Picture other = grey;
  change_picture(change, 1, once);
  change_picture(change, 1, again);
  change_picture(change, 2, other);
  EXPECT_EQ(once.pixels, again.pixels);
  EXPECT_NE(once.pixels, other.pixels);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(cv::Mat(once.pixels), mean, deviation);
  EXPECT_NEAR(mean[0], 128.0, 0.1);
  EXPECT_NEAR(deviation[0], 5.0, 0.1);
}

TEST(PictureChange, LiftsShadowsAndKeepsColours) {
  Picture picture({320, 240}, PixelFormat::rgb8);
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3) {
    const bool is_dark = i < picture.pixels.size() / 2;
    const auto shade = static_cast<std::uint8_t>((is_dark ? 20 : 200) + (i / 3 * 7) % 20);
    picture.pixels[i] = picture.pixels[i + 1] = picture.pixels[i + 2] = shade;
  }
  const Picture before = picture;
  change_picture({0.0, true}, 1, picture);
  const auto mean_of_dark = [](const Picture& own) {
    return cv::mean(cv::Mat(own.pixels).rowRange(0, static_cast<int>(own.pixels.size()) / 2))[0];
  };
  EXPECT_GT(mean_of_dark(picture), mean_of_dark(before) + 5.0);
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3)
    ASSERT_NEAR(picture.pixels[i], picture.pixels[i + 2], 2) << "grey stays grey";
}

std::vector<PairTask> tasks_of(int captures, int pairs) {
  std::vector<PairTask> tasks;
  for (int capture = 0; capture < captures; ++capture) {
    const std::string name = std::to_string(100 + capture);
    for (int pair = 0; pair < pairs; ++pair) tasks.push_back({name, name, {0, pair + 1}});
  }
  return tasks;
}

// How often each capture and each place among a capture's pairs was taken.
struct Uses {
  explicit Uses(const std::vector<PairTask>& tasks) {
    for (const PairTask& task : tasks) {
      ++captures[task.capture];
      ++pairs[task.pair[1]];
    }
  }
  std::map<std::string, int> captures;
  std::map<int, int> pairs;
};

template <class Key>
std::pair<int, int> range_of(const std::map<Key, int>& counts) {
  std::pair<int, int> range{1000, 0};
  for (const auto& [key, count] : counts) {
    range = {std::min(range.first, count), std::max(range.second, count)};
  }
  return range;
}

TEST(SpreadOut, TakesAllAnglesOfASetWhoseCapturesHaveThemInTheSameOrder) {
  const Uses uses(spread_out(tasks_of(13, 7), 13));
  EXPECT_EQ(uses.captures.size(), 13U);
  EXPECT_EQ(uses.pairs.size(), 7U);
  EXPECT_EQ(range_of(uses.pairs), std::pair(1, 2));
}

TEST(SpreadOut, TakesEveryCaptureAndPlaceAlike) {
  for (const int wanted : {9, 15, 45, 60, 100}) {
    const std::vector<PairTask> chosen = spread_out(tasks_of(45, 3), wanted);
    ASSERT_EQ(chosen.size(), static_cast<std::size_t>(wanted));
    const Uses uses(chosen);
    EXPECT_EQ(uses.captures.size(), static_cast<std::size_t>(std::min(wanted, 45))) << wanted;
    EXPECT_LE(range_of(uses.captures).second, range_of(uses.captures).first + 1) << wanted;
    EXPECT_EQ(uses.pairs.size(), 3U) << wanted;
    EXPECT_LE(range_of(uses.pairs).second, range_of(uses.pairs).first + 2) << wanted;
  }
}

TEST(SpreadOut, KeepsTheOrderAndTakesNothingTwice) {
  std::vector<PairTask> tasks = tasks_of(2, 1);
  const std::vector<PairTask> longer = tasks_of(4, 3);
  tasks.insert(tasks.end(), longer.begin() + 6, longer.end());  // captures of 1, 1, 3 and 3 pairs
  EXPECT_EQ(spread_out(tasks, 0).size(), 8U);
  EXPECT_EQ(spread_out(tasks, 20).size(), 8U);
  const std::vector<PairTask> chosen = spread_out(tasks, 7);
  ASSERT_EQ(chosen.size(), 7U);
  const auto rank = [](const PairTask& task) { return std::pair(task.capture, task.pair[1]); };
  for (std::size_t i = 1; i < chosen.size(); ++i) EXPECT_LT(rank(chosen[i - 1]), rank(chosen[i]));
}

}  // namespace
}  // namespace traygauge::tables
