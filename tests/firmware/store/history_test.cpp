#include "firmware/store/history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "tests/firmware/store/open_sample.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

using Ids = std::vector<std::string>;

class HistoryTest : public StoreTest {
 protected:
  static SampleScan sample(std::uint64_t number) {
    SampleScan scan;
    scan.id.number = number;
    scan.taken_ms = kMorningMs + static_cast<std::int64_t>(number) * 1000;
    return scan;
  }
  template <class SetFilter>
  Ids found(SetFilter set) {
    HistoryFilter filter;
    set(filter);
    Ids ids;
    const Expected<HistoryPage> page = store_->history().page(filter, 1000);
    EXPECT_TRUE(page.ok());
    if (page.ok()) {
      for (const StoredScan& scan : page->scans) ids.push_back(scan_id_text(scan.id));
    }
    return ids;
  }
};

TEST_F(HistoryTest, FiltersByEachOfItsParts) {
  SampleScan scan = sample(1);
  scan.foods = {"Reis"};
  put(sample_document(scan));
  scan = sample(2);
  scan.foods = {"Spätzle", "Erbsen"};
  scan.tray = "Tablett Nord";
  scan.supersedes = ScanId{"kitchen", 1};
  put(sample_document(scan));
  scan = sample(3);
  scan.id.station = "bakery";
  scan.status = "card_not_found";
  scan.foods = {};
  put(sample_document(scan));
  ASSERT_TRUE(
      store_->corrections().add({"kitchen", 2}, RenameItem{3, "Bohnen"}, "chef", "", at(kMorningMs)).ok());
  ASSERT_TRUE(store_->corrections().add({"bakery", 3}, MarkScanWrong{}, "chef", "", at(kMorningMs)).ok());

  EXPECT_EQ(found([](HistoryFilter&) {}), (Ids{"bakery-3", "kitchen-2", "kitchen-1"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.from_ms = kMorningMs + 2000; }),
            (Ids{"bakery-3", "kitchen-2"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.to_ms = kMorningMs + 2000; }), (Ids{"kitchen-1"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.station = "bakery"; }), (Ids{"bakery-3"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.status = "ok"; }), (Ids{"kitchen-2", "kitchen-1"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.food = "SPÄTZLE"; }), (Ids{"kitchen-2"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.food = "spätz"; }), Ids{});
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.food = "bohnen"; }), (Ids{"kitchen-2"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.food = "erbsen"; }), Ids{}) << "it was corrected";
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.text = "erbs"; }), (Ids{"kitchen-2"}))
      << "it was measured";
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.text = "bohn"; }), (Ids{"kitchen-2"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.text = "nord"; }), (Ids{"kitchen-2"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.text = "kitchen-"; }), (Ids{"kitchen-2", "kitchen-1"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.text = "' OR 1 --"; }), Ids{});
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.is_corrected = true; }), (Ids{"bakery-3", "kitchen-2"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.is_corrected = false; }), (Ids{"kitchen-1"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.is_wrong = true; }), (Ids{"bakery-3"}));
  EXPECT_EQ(found([](HistoryFilter& filter) { filter.with_superseded = false; }),
            (Ids{"bakery-3", "kitchen-2"}));
  EXPECT_EQ(found([](HistoryFilter& filter) {
              filter.from_ms = kMorningMs;
              filter.station = "kitchen";
              filter.text = "reis";
            }),
            (Ids{"kitchen-1"}));
}

// Scans arrive and are deleted while somebody turns pages: who was there from the beginning to the end is
// seen once, in order, and nobody twice. With windows so small that many pages are empty.
TEST_F(HistoryTest, PagesNeitherRepeatNorHideScans) {
  std::mt19937_64 random(random_seed());
  for (const HistoryOrder order : {HistoryOrder::newest_first, HistoryOrder::oldest_first}) {
    std::uint64_t last = 0;
    reopen();
    ASSERT_TRUE(store_->database().run_script("test", "DELETE FROM scans").ok());
    const auto add = [&] {
      SampleScan scan = sample(++last);
      scan.tray = random() % 4 == 0 ? "wanted" : "other";
      put(sample_document(scan));
      return scan.tray == "wanted";
    };
    std::set<std::uint64_t> wanted;
    for (int i = 0; i < 60; ++i) {
      if (add()) wanted.insert(last);
    }
    History history(store_->database(), 1 + static_cast<std::int64_t>(random() % 9));
    HistoryFilter filter;
    filter.text = "wanted";
    std::vector<std::uint64_t> seen;
    std::optional<HistoryCursor> cursor;
    int pages = 0;
    do {
      const Expected<HistoryPage> page = history.page(filter, 1 + random() % 4, cursor, order);
      ASSERT_TRUE(page.ok()) << page.failure();
      for (const StoredScan& scan : page->scans) seen.push_back(scan.id.number);
      cursor = page->next;
      if (cursor) {
        ASSERT_EQ(parse_history_cursor(history_cursor_text(*cursor)), cursor);
      }
      if (random() % 2 == 0 && last < 80) add();
      const std::uint64_t gone = 1 + random() % last;
      ASSERT_TRUE(store_->database()
                      .execute("test", "DELETE FROM scans WHERE number = ?1", static_cast<std::int64_t>(gone))
                      .ok());
      wanted.erase(gone);
      ASSERT_LT(++pages, 200);
    } while (cursor);
    for (std::size_t i = 1; i < seen.size(); ++i) {
      EXPECT_TRUE(order == HistoryOrder::newest_first ? seen[i] < seen[i - 1] : seen[i] > seen[i - 1]);
    }
    for (const std::uint64_t number : wanted) {
      EXPECT_EQ(std::count(seen.begin(), seen.end(), number), 1) << number;
    }
  }
}

TEST_F(HistoryTest, AnEmptyStoreHasAnEmptyPage) {
  for (const HistoryOrder order : {HistoryOrder::newest_first, HistoryOrder::oldest_first}) {
    const Expected<HistoryPage> page = store_->history().page({}, 10, std::nullopt, order);
    ASSERT_TRUE(page.ok()) << page.failure();
    EXPECT_TRUE(page->scans.empty());
    EXPECT_FALSE(page->next);
  }
}

TEST_F(HistoryTest, AnExportGoesThroughAllAndStopsWhenTold) {
  for (std::uint64_t number = 1; number <= 250; ++number) put(sample_document(sample(number)));
  std::uint64_t next = 101;
  HistoryFilter filter;
  filter.from_ms = sample(101).taken_ms;
  ASSERT_TRUE(store_->history()
                  .for_each(filter,
                            [&](const StoredScan& scan) {
                              EXPECT_EQ(scan.id.number, next);
                              EXPECT_FALSE(scan.document.empty());
                              ++next;
                              return true;
                            })
                  .ok());
  EXPECT_EQ(next, 251U);
  int seen = 0;
  ASSERT_TRUE(store_->history().for_each({}, [&](const StoredScan&) { return ++seen < 120; }).ok());
  EXPECT_EQ(seen, 120);
}

TEST(HistoryCursor, OneTextNamesAPlace) {
  for (const char* const text : {"", "a", "b12", "12", "a-1", "a+1", "a1 ", "azzzzzzzzzzzzzzzzz", "a1\n"}) {
    EXPECT_FALSE(parse_history_cursor(text)) << text;
  }
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t seq : {std::int64_t{0}, std::int64_t{35}, kLast}) {
    EXPECT_EQ(parse_history_cursor(history_cursor_text({seq})), HistoryCursor{seq});
  }
}

TEST_F(HistoryTest, ACursorAtEitherEndIsHarmless) {
  put(sample_document(1));
  for (const std::int64_t seq : {std::int64_t{0}, std::numeric_limits<std::int64_t>::max()}) {
    for (const HistoryOrder order : {HistoryOrder::newest_first, HistoryOrder::oldest_first}) {
      const Expected<HistoryPage> page = store_->history().page({}, 5, HistoryCursor{seq}, order);
      ASSERT_TRUE(page.ok()) << page.failure();
      EXPECT_EQ(page->scans.size(), (seq == 0) == (order == HistoryOrder::oldest_first) ? 1U : 0U);
    }
  }
}

}  // namespace
}  // namespace traygauge::test
