// What the running hub says of its stations is what one says that has just read the store.
#include "firmware/drift/drift_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <random>

#include "tests/firmware/drift/sorted_median.hpp"
#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using SteadyClock = std::chrono::steady_clock;

class Watched : public testing::Test {
 protected:
  Watched() : store_(opened()) {}

  HubStore opened() {
    HubStoreParams params;
    params.options.file = folder_.path() / "results.db";
    Expected<HubStore> store = HubStore::open(params);
    if (!store.ok()) throw std::runtime_error(store.failure());
    return std::move(*store);
  }
  static SampleScan sample(std::uint64_t number, double scale_percent) {
    SampleScan scan;
    scan.id.number = number;
    scan.scale_percent = scale_percent;
    scan.glaze_height_mm = 0.1;
    return scan;
  }
  void put(const SampleScan& scan) {
    const auto put = store_.store()->scans().put(sample_document(scan), at(kMorningMs + ++received_));
    ASSERT_TRUE(put.ok()) << put.failure();
    ASSERT_EQ(put->outcome, PutOutcome::stored) << put->why;
  }
  void correct(const ScanId& id, const CorrectionAction& action) {
    const auto booked = store_.store()->corrections().add(id, action, "ann", "", at(kMorningMs));
    ASSERT_TRUE(booked.ok()) << booked.failure();
  }

  MemoryFolder folder_;
  std::int64_t received_ = 0;
  HubStore store_;
};

// "kitchen scale_percent 0.100000000000 ± 0.0200000 of 50", a line each.
std::string told(const std::vector<StationTrends>& stations) {
  std::string text;
  const auto add = [&text](const char* what, const MedianEstimate& estimate) {
    text += what + std::to_string(estimate.value * 1e6) + " ± " + std::to_string(estimate.sigma * 1e6) +
            " of " + std::to_string(estimate.count);
  };
  for (const StationTrends& station : stations) {
    for (const CheckTrend& trend : station.trends) {
      text += station.station + " " + name(trend.check);
      add(" ", trend.last);
      if (trend.first) add(", first ", *trend.first);
      text += trend.drifts ? ", drifts\n" : "\n";
    }
  }
  return text;
}

std::vector<StationTrends> read_anew(HubStore& store, const DriftParams& params) {
  DriftWatch watch(store, params);
  const Expected<void> read = watch.follow(SteadyClock::now());
  EXPECT_TRUE(read.ok()) << read.failure();
  return watch.trends();
}

// By the definition, from all scans of the store.
std::vector<StationTrends> computed(HubStore& store, const DriftParams& params) {
  std::map<std::string, std::map<std::uint64_t, StoredScan>> all;
  const Expected<void> read = store.store()->history().for_each({}, [&](const StoredScan& scan) {
    all[scan.id.station].emplace(scan.id.number, scan);
    return true;
  });
  EXPECT_TRUE(read.ok());
  std::vector<StationTrends> stations;
  for (const auto& [name, scans] : all) {
    StationTrends trends{name, 0, {}};
    for (std::size_t i = 0; i < kWatchedChecks; ++i) {
      const auto take = [&](auto begin, auto end, std::vector<std::uint64_t>& numbers) {
        std::vector<double> values;
        std::size_t looked_at = 0;
        for (auto at = begin; at != end && looked_at++ < params.scans_looked_at; ++at) {
          const StoredScan& scan = at->second;
          const auto value = read_check_values(scan.document)[i];
          if (!value || scan.superseded_by || scan.is_wrong || values.size() == params.values) continue;
          values.push_back(*value);
          numbers.push_back(scan.id.number);
        }
        return values;
      };
      std::vector<std::uint64_t> first_numbers;
      std::vector<std::uint64_t> last_numbers;
      const auto first = take(scans.begin(), scans.end(), first_numbers);
      const auto last = take(scans.rbegin(), scans.rend(), last_numbers);
      if (last.empty()) continue;
      const bool are_others = !first.empty() && first_numbers.back() < last_numbers.back();
      trends.trends.push_back(judge_trend(static_cast<WatchedCheck>(i), sorted_estimate(last),
                                          are_others ? std::optional(sorted_estimate(first)) : std::nullopt,
                                          params));
    }
    stations.push_back(trends);
  }
  return stations;
}

TEST_F(Watched, NothingIsSaidOfAnEmptyStore) {
  EXPECT_TRUE(read_anew(store_, {}).empty());
}

TEST_F(Watched, TheLastFiftyCount) {
  for (std::uint64_t number = 1; number <= 60; ++number) put(sample(number, number <= 10 ? 100.0 : 0.7));
  const std::vector<StationTrends> stations = read_anew(store_, {});
  ASSERT_EQ(stations.size(), 1U);
  EXPECT_EQ(stations[0].station, "kitchen");
  EXPECT_EQ(stations[0].last_received_ms, kMorningMs + 60);
  ASSERT_EQ(stations[0].trends.size(), kWatchedChecks);
  EXPECT_EQ(stations[0].trends[0].last.count, 50U);
  EXPECT_EQ(stations[0].trends[0].last.value, 0.7);
  EXPECT_EQ(stations[0].trends[0].last.sigma, 0.0) << "none of the first ten is left";
  EXPECT_TRUE(stations[0].trends[0].drifts);
}

TEST_F(Watched, BlurIsComparedOnceFirstAndLastAreOthers) {
  SampleScan scan;
  const auto blur_drifts = [this] { return read_anew(store_, {})[0].trends[2].drifts; };
  for (scan.id.number = 1; scan.id.number <= 50; ++scan.id.number) {
    scan.blur_px = {0.8, 0.8};
    put(scan);
  }
  for (; scan.id.number <= 99; ++scan.id.number) {
    scan.blur_px = {1.2, 1.2};
    put(scan);
  }
  EXPECT_FALSE(blur_drifts()) << "49 scans: one of the last 50 is one of the first";
  put(scan);
  EXPECT_TRUE(blur_drifts());
}

TEST_F(Watched, ScansOfEarlierProgramsSayNothing) {
  SampleScan scan;
  scan.has_checks = false;
  for (scan.id.number = 1; scan.id.number <= 30; ++scan.id.number) put(scan);
  const std::vector<StationTrends> stations = read_anew(store_, {});
  ASSERT_EQ(stations.size(), 1U);
  EXPECT_TRUE(stations[0].trends.empty());
}

TEST_F(Watched, SupersededAndWrongScansAreLeftOut) {
  DriftWatch watch(store_);
  ASSERT_TRUE(watch.follow(SteadyClock::now()).ok());
  const auto values = [&watch] { return watch.trends().at(0).trends.at(0).last; };
  for (std::uint64_t number = 1; number <= 3; ++number) {
    put(sample(number, static_cast<double>(number)));
    watch.note({"kitchen", number});
  }
  EXPECT_EQ(values().count, 3U);
  SampleScan again = sample(4, 4.0);
  again.supersedes = ScanId{"kitchen", 3};
  put(again);
  watch.note({"kitchen", 4});
  EXPECT_EQ(values().value, 2.0) << "of 1, 2 and 4";
  correct({"kitchen", 1}, MarkScanWrong{});
  watch.note({"kitchen", 1});
  EXPECT_EQ(values().value, 3.0) << "of 2 and 4";
  correct({"kitchen", 1}, UndoCorrection{1});
  watch.note({"kitchen", 1});
  EXPECT_EQ(values().value, 2.0);
}

// Small windows, so that scans leave them all the time; late arrivals, second tries that arrive before what
// they supersede, corrections that are taken back.
TEST_F(Watched, SaysTheSameAsAfterARestart) {
  std::mt19937 random(random_seed());
  DriftParams params;
  params.values = 5;
  params.min_values = 3;
  params.scans_looked_at = 9;
  DriftWatch watch(store_, params);
  ASSERT_TRUE(watch.follow(SteadyClock::now()).ok());
  std::map<std::string, std::uint64_t> last;
  std::map<ScanId, int, bool (*)(const ScanId&, const ScanId&)> corrected(
      [](const ScanId& one, const ScanId& other) { return scan_id_text(one) < scan_id_text(other); });
  std::vector<ScanId> stored;
  std::vector<SampleScan> late;
  const auto hand_over = [&](const SampleScan& scan) {
    put(scan);
    watch.note(scan.id);
    stored.push_back(scan.id);
  };
  for (int step = 0; step < 200; ++step) {
    if (!stored.empty() && random() % 5 == 0) {
      const ScanId id = stored[random() % stored.size()];
      const int number = corrected[id]++;
      const bool takes_back = number % 2 == 1;
      correct(id, takes_back ? CorrectionAction(UndoCorrection{number}) : CorrectionAction(MarkScanWrong{}));
      watch.note(id);
    } else {
      SampleScan scan;
      scan.id.station = random() % 3 == 0 ? "buffet" : "kitchen";
      std::uint64_t& number = last[scan.id.station];
      scan.id.number = ++number;
      scan.has_checks = random() % 6 != 0;
      if (random() % 4 == 0) {
        scan.scale_percent.reset();
      } else {
        scan.scale_percent = 0.1 * static_cast<double>(random() % 8);
      }
      scan.dish_height_mm = -0.1 * static_cast<double>(random() % 8);
      if (random() % 3 == 0) scan.glaze_height_mm = 0.2 * static_cast<double>(random() % 8);
      scan.blur_px = {0.8 + 0.1 * static_cast<double>(random() % 8), std::nullopt};
      if (number > 1 && random() % 4 == 0) scan.supersedes = ScanId{scan.id.station, number - 1};
      if (random() % 6 == 0) {
        late.push_back(scan);
      } else {
        hand_over(scan);
      }
    }
    if (!late.empty() && random() % 8 == 0) {
      hand_over(late.front());
      late.erase(late.begin());
    }
    const std::string expected = told(computed(store_, params));
    ASSERT_EQ(told(watch.trends()), expected) << "step " << step;
    if (step % 10 != 0) continue;
    ASSERT_EQ(told(read_anew(store_, params)), expected) << "step " << step;
  }
}

// What was known of a store that was damaged means nothing in the one that took its place.
TEST_F(Watched, FollowsAStoreThatWasOpenedAnew) {
  DriftWatch watch(store_);
  put(sample(1, 1.0));
  ASSERT_TRUE(watch.follow(SteadyClock::now()).ok());
  EXPECT_EQ(watch.trends().size(), 1U);
  store_.store()->database().note_damage("for a test");
  std::filesystem::resize_file(folder_.path() / "results.db", 100);
  store_.tend(SteadyClock::now());
  ASSERT_NE(store_.store(), nullptr);
  watch.note({"kitchen", 1});
  ASSERT_TRUE(watch.follow(SteadyClock::now()).ok());
  EXPECT_TRUE(watch.trends().empty());
  put(sample(1, 2.0));
  watch.note({"kitchen", 1});
  EXPECT_EQ(watch.trends().at(0).trends.at(0).last.value, 2.0);
}

// A disk that fails for a while: what came meanwhile is read later, and not at each step of the hub's loop.
TEST_F(Watched, ReadsAnewWhatCouldNotBeRead) {
  DriftWatch watch(store_);
  const auto begin = SteadyClock::now();
  ASSERT_TRUE(watch.follow(begin).ok());
  put(sample(1, 1.0));
  Database& database = store_.store()->database();
  ASSERT_TRUE(database.run_script("test", "ALTER TABLE documents RENAME TO hidden").ok());
  watch.note({"kitchen", 1});
  const Expected<void> failed = watch.follow(begin);
  ASSERT_FALSE(failed.ok());
  EXPECT_NE(failed.failure().find("the history cannot be read"), std::string::npos) << failed.failure();
  ASSERT_TRUE(database.run_script("test", "ALTER TABLE hidden RENAME TO documents").ok());
  EXPECT_TRUE(watch.follow(begin + std::chrono::seconds(59)).ok());
  EXPECT_TRUE(watch.trends().empty());
  EXPECT_TRUE(watch.follow(begin + std::chrono::seconds(60)).ok());
  EXPECT_EQ(watch.trends().size(), 1U);
}

TEST_F(Watched, MoreStationsThanItsLimitAreNotWatched) {
  DriftParams params;
  params.max_stations = 2;
  DriftWatch watch(store_, params);
  ASSERT_TRUE(watch.follow(SteadyClock::now()).ok());
  for (const std::string station : {"a", "b", "c"}) {
    SampleScan scan;
    scan.id.station = station;
    put(scan);
    watch.note(scan.id);
  }
  EXPECT_EQ(watch.trends().size(), 2U);
  EXPECT_EQ(told(watch.trends()), told(read_anew(store_, params)));
}

// At the start of a hub the watchdog waits, and so do stations: what stands further away is not read.
TEST_F(Watched, LooksAtABoundedNumberOfScans) {
  const std::size_t looked_at = DriftParams().scans_looked_at;
  SampleScan scan;
  const auto put_next = [&](std::size_t count, bool has_checks) {
    scan.has_checks = has_checks;
    for (std::size_t i = 0; i < count; ++i, ++scan.id.number) put(scan);
  };
  put_next(300, true);
  put_next(looked_at - 1, false);
  EXPECT_EQ(read_anew(store_, {}).at(0).trends.at(0).last.count, 1U);
  put_next(1, false);
  EXPECT_TRUE(read_anew(store_, {}).at(0).trends.empty());
  put_next(looked_at, true);
  const auto begin = SteadyClock::now();
  EXPECT_EQ(read_anew(store_, {}).at(0).trends.at(0).last.count, 50U);
  const std::chrono::duration<double, std::milli> taken = SteadyClock::now() - begin;
  std::cout << taken.count() << " ms to read both ends of what a station has stored" << std::endl;
}

TEST(StationTrends, OfAStationThatIsGoneAreForgotten) {
  constexpr std::int64_t kDayMs = 86'400'000;
  const StationTrends station{"kitchen", kMorningMs, {}};
  EXPECT_TRUE(still_measures(station, at(kMorningMs), {}));
  EXPECT_TRUE(still_measures(station, at(kMorningMs + 90 * kDayMs), {}));
  EXPECT_FALSE(still_measures(station, at(kMorningMs + 90 * kDayMs + 1), {}));
  EXPECT_TRUE(still_measures(station, at(0), {})) << "a hub without a clock";
}

}  // namespace
}  // namespace traygauge::test
