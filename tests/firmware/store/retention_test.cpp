#include "firmware/store/retention.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/firmware/store/open_sample.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using std::chrono::hours;
constexpr std::int64_t kDayMs = 24LL * 3600 * 1000;
constexpr std::int64_t kTenYearsMs = 3650 * kDayMs;

class RetentionTest : public StoreTest {
 protected:
  void SetUp() override {
    options_.free_space = [this](const std::filesystem::path&) -> Expected<std::int64_t> {
      return free_bytes_;
    };
    StoreTest::SetUp();
    rules_.keep_newest = 1;
  }
  // One a day.
  void put_days(int days, std::int64_t first_ms = kMorningMs, bool synchronised = true) {
    for (int day = 0; day < days; ++day) {
      put(sample_document(++last_), {first_ms + day * kDayMs, synchronised});
    }
  }
  // Once an hour, for so long.
  void run_for(hours time, const WallTime& begin) {
    for (hours passed{0}; passed <= time; ++passed) {
      steady_ += hours(1);
      run({begin.unix_ms + std::chrono::milliseconds(passed).count(), begin.synchronised});
    }
  }
  RetentionReport run(const WallTime& now) {
    const Expected<RetentionReport> report = store_->retention().run(rules_, now, steady_);
    EXPECT_TRUE(report.ok()) << report.failure();
    if (!report.ok()) return {};
    reported_ += report->deleted_by_age + report->deleted_for_space;
    return *report;
  }
  std::set<std::uint64_t> numbers() {
    std::set<std::uint64_t> numbers;
    const Expected<void> read = store_->history().for_each({}, [&](const StoredScan& scan) {
      numbers.insert(scan.id.number);
      return true;
    });
    EXPECT_TRUE(read.ok());
    EXPECT_EQ(static_cast<std::int64_t>(numbers.size()), store_->scans().totals()->counts.scans);
    return numbers;
  }

  std::int64_t free_bytes_ = 1'000'000'000;
  RetentionRules rules_;
  std::chrono::steady_clock::time_point steady_;
  std::uint64_t last_ = 0;
  std::int64_t reported_ = 0;
};

TEST_F(RetentionTest, DeletesNothingWithoutRules) {
  put_days(5);
  const RetentionReport report = run(at(kMorningMs + kTenYearsMs));
  EXPECT_EQ(numbers().size(), 5U);
  EXPECT_EQ(report.text, "");
}

TEST_F(RetentionTest, DeletesByAgeAndLeavesNothingOfTheScan) {
  rules_.max_age = hours(24 * 20);
  put_days(40);
  ASSERT_TRUE(store_->corrections().add({"kitchen", 1}, MarkScanWrong{}, "chef", "", at(0)).ok());
  run_for(hours(24 * 6), at(kMorningMs + 40 * kDayMs));
  // On the last day, the 46th, scans up to the 25th were older than 20 days.
  EXPECT_EQ(*numbers().begin(), 27U);
  EXPECT_EQ(numbers().size(), 14U);
  EXPECT_EQ(reported_, 26);
  EXPECT_EQ(*store_->database().integer("test", "SELECT count(*) FROM documents"), 14);
  EXPECT_EQ(*store_->database().integer("test", "SELECT count(*) FROM corrections"), 0);
  EXPECT_GT(store_->scans().totals()->free_bytes, 0);
}

TEST_F(RetentionTest, SaysWhatItDid) {
  rules_.max_age = hours(24 * 4);
  put_days(10);
  run(at(kMorningMs + 10 * kDayMs));
  steady_ += hours(12);
  const RetentionReport report = run(at(kMorningMs + 10 * kDayMs));
  EXPECT_GT(report.deleted_by_age, 0);
  EXPECT_NE(report.text.find("older than 4 days"), std::string::npos) << report.text;
}

TEST_F(RetentionTest, AClockTenYearsAheadCostsLittle) {
  rules_.max_age = hours(24 * 400);
  put_days(400);
  run_for(hours(72), at(kMorningMs + 400 * kDayMs + kTenYearsMs));
  // Three days: at most 4 times 3 of 400.
  EXPECT_GE(numbers().size(), 388U);
  EXPECT_LT(numbers().size(), 400U) << "it cannot be told from a hub that was off for ten years";
}

TEST_F(RetentionTest, AClockThatIsNotSynchronisedDeletesNothingByAge) {
  rules_.max_age = hours(24 * 5);
  put_days(20);
  run_for(hours(240), {kMorningMs + kTenYearsMs, false});
  EXPECT_EQ(numbers().size(), 20U);
}

TEST_F(RetentionTest, AClockTenYearsBehindDeletesNothing) {
  rules_.max_age = hours(24 * 5);
  put_days(20);
  // Received while the clock was ten years behind, and said to be right.
  put_days(5, kMorningMs - kTenYearsMs);
  put_days(20, kMorningMs + 20 * kDayMs);
  run_for(hours(240), at(kMorningMs - kTenYearsMs));
  EXPECT_EQ(numbers().size(), 45U);
  // The clock is right again: of 43 days all but five expire, and those between with them.
  run_for(hours(24 * 40), at(kMorningMs + 3 * kDayMs));
  EXPECT_EQ(*numbers().begin(), 44U);
}

TEST_F(RetentionTest, OfTheRightTimeTheNextScanDecides) {
  rules_.max_age = hours(24 * 5);
  put_days(3);
  put_days(3, 0, false);  // 1970, the clock was not set
  put_days(3, kMorningMs + 3 * kDayMs);
  put_days(3, 0, false);
  run_for(hours(24 * 30), at(kMorningMs + 3 * kDayMs));
  // The scan 9 makes those before it older; what follows it has no time that can be trusted.
  EXPECT_EQ(numbers(), (std::set<std::uint64_t>{10, 11, 12}));
}

TEST_F(RetentionTest, FreesSpaceOldestFirstAndSaysWhenItCannot) {
  put_days(300);
  free_bytes_ = 900'000;
  rules_.min_free_bytes = 1'000'000;
  RetentionReport report;
  int calls = 0;
  do {
    report = run(at(kMorningMs));
    ASSERT_LT(++calls, 10);
  } while (report.has_more);
  EXPECT_EQ(report.missing_bytes, 0);
  const std::set<std::uint64_t> left = numbers();
  EXPECT_EQ(*left.begin(), 301 - left.size()) << "oldest first";
  EXPECT_GT(left.size(), 250U) << "no more than needed";
  EXPECT_LT(left.size(), 280U);
  EXPECT_NE(report.text.find("to free space"), std::string::npos) << report.text;

  rules_.min_free_bytes = 100'000'000;
  calls = 0;
  do {
    report = run(at(kMorningMs));
    EXPECT_LE(report.deleted_for_space, rules_.max_deleted_a_call);
    ASSERT_LT(++calls, 10);
  } while (report.has_more);
  EXPECT_EQ(numbers(), (std::set<std::uint64_t>{300}));
  EXPECT_GT(report.missing_bytes, 0);
  EXPECT_NE(report.text.find("no further scan may be deleted"), std::string::npos) << report.text;
}

TEST_F(RetentionTest, AScanWhoseCorrectionWaitsStays) {
  options_.destinations = {"webhook"};
  reopen();
  rules_.keep_newest = 1;
  rules_.max_age = hours(24);
  put_days(3, kMorningMs);
  ASSERT_TRUE(store_->deliveries().mark_delivered("webhook", std::vector<DeliveryKey>{{1}, {2}, {3}}).ok());
  ASSERT_TRUE(store_->corrections().add({"kitchen", 1}, MarkScanWrong{}, "chef", "", at(kMorningMs)).ok());
  const WallTime later{kMorningMs + 100 * kDayMs, true};
  while (run(later).has_more || numbers().size() > 2) steady_ += hours(24);
  EXPECT_EQ(numbers(), (std::set<std::uint64_t>{1, 3}));
}

// Whatever the rules and the clock: what waits for somebody stays, and so do the newest.
TEST_F(RetentionTest, NeverDeletesWhatWaitsNorTheNewest) {
  std::mt19937_64 random(random_seed());
  options_.destinations = {"webhook", "broker"};
  reopen();
  rules_.keep_newest = 7;
  rules_.max_deleted_a_call = 9;
  std::set<std::uint64_t> waiting;
  for (int round = 0; round < 40; ++round) {
    put_days(static_cast<int>(random() % 6), kMorningMs + round * kDayMs, random() % 4 != 0);
    for (const char* const name : {"webhook", "broker"}) {
      std::vector<DeliveryKey> told;
      const auto due = store_->deliveries().due(name, kMorningMs, 1000);
      for (const PendingDelivery& delivery : *due) {
        if (random() % 8 == 0) told.push_back(delivery.key);
      }
      ASSERT_TRUE(store_->deliveries().mark_delivered(name, told).ok());
    }
    waiting.clear();
    for (const char* const name : {"webhook", "broker"}) {
      const auto due = store_->deliveries().due(name, kMorningMs, 1000);
      for (const PendingDelivery& delivery : *due) waiting.insert(delivery.id.number);
    }
    rules_.max_age = random() % 2 == 0 ? std::optional(hours(24 + random() % 100)) : std::nullopt;
    rules_.min_free_bytes = random() % 2 == 0 ? 0 : 10'000'000'000;
    steady_ += hours(random() % 100);
    const WallTime now{kMorningMs + static_cast<std::int64_t>(random() % 100) * kDayMs, random() % 4 != 0};
    while (run(now).has_more) steady_ += hours(1);
    const std::set<std::uint64_t> left = numbers();
    for (const std::uint64_t number : waiting) ASSERT_EQ(left.count(number), 1U) << number;
    for (std::uint64_t back = 0; back < 7 && back < last_; ++back) ASSERT_EQ(left.count(last_ - back), 1U);
  }
  EXPECT_GT(reported_, 0);
  EXPECT_EQ(static_cast<std::uint64_t>(reported_) + numbers().size(), last_);
}

TEST_F(RetentionTest, AFileSystemThatDoesNotAnswerIsAFailure) {
  Retention retention(store_->database(), store_->scans());
  RetentionRules rules;
  rules.min_free_bytes = 1;
  EXPECT_TRUE(retention.run(rules, at(kMorningMs), steady_).ok());
  EXPECT_FALSE(free_bytes_of(folder_.path() / "missing").ok());
  EXPECT_GT(*free_bytes_of(folder_.path()), 0);
}

// A store of which a long row of scans waits is looked through piece by piece.
TEST_F(RetentionTest, GoesOnBehindALongRowOfScansThatWait) {
  options_.destinations = {"webhook"};
  reopen();
  put_days(1005);
  options_.destinations = {};
  reopen();
  put_days(50);
  rules_.min_free_bytes = 10'000'000'000;
  EXPECT_TRUE(run(at(kMorningMs)).has_more);
  EXPECT_FALSE(run(at(kMorningMs)).has_more);
  EXPECT_EQ(numbers().size(), 1006U);
}

}  // namespace
}  // namespace traygauge::test
