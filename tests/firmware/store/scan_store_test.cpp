#include "firmware/store/scan_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "tests/firmware/store/open_sample.hpp"
#include "tests/firmware/store/sample_work.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

class ScanStoreTest : public StoreTest {
 protected:
  PutOutcome outcome(const std::string& document) {
    const Expected<PutResult> result = store_->scans().put(document, at(kMorningMs));
    if (result.ok()) return result->outcome;
    ADD_FAILURE() << result.failure();
    return PutOutcome::set_aside;
  }
  std::optional<StoredScan> find(std::uint64_t number) {
    const auto found = store_->scans().find({"kitchen", number});
    EXPECT_TRUE(found.ok());
    return found.ok() ? *found : std::nullopt;
  }
  StoreTotals totals() {
    const Expected<StoreTotals> totals = store_->scans().totals();
    EXPECT_TRUE(totals.ok());
    return totals.ok() ? *totals : StoreTotals();
  }
  // As they are counted when nothing is remembered.
  StoreTotals counted_anew() {
    store_->scans().note_change(Failure{"forget"}, {});
    return totals();
  }
};

TEST_F(ScanStoreTest, KeepsADocumentAsItCame) {
  SampleScan sample;
  sample.clock_synchronised = false;
  // A key that nobody here knows, and spaces.
  const std::string document = "  {\"moon\": \"full\" ," + sample_document(sample).substr(1);
  put(document, {kMorningMs + 5, true});
  reopen();
  const auto scan = find(1);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->document, document);
  EXPECT_EQ(scan->taken, (WallTime{sample.taken_ms, false}));
  EXPECT_EQ(scan->received, (WallTime{kMorningMs + 5, true}));
  EXPECT_EQ(scan->status, "ok");
  EXPECT_FALSE(scan->is_corrected || scan->is_wrong || scan->superseded_by || scan->supersedes);
  EXPECT_FALSE(find(2));
}

TEST_F(ScanStoreTest, TheSameDocumentIsStoredOnce) {
  put(sample_document(1));
  EXPECT_EQ(outcome(sample_document(1)), PutOutcome::already_stored);
  // As another program writes it.
  EXPECT_EQ(outcome(nlohmann::json::parse(sample_document(1)).dump(4)), PutOutcome::already_stored);
  reopen();
  EXPECT_EQ(outcome(sample_document(1)), PutOutcome::already_stored);
  EXPECT_EQ(totals().counts.scans, 1);
  EXPECT_EQ(totals().counts.set_aside, 0);
}

TEST_F(ScanStoreTest, AnotherDocumentOfTheSameIdIsSetAsideOnce) {
  put(sample_document(1));
  SampleScan other;
  other.tray = "another tray";
  for (int i = 0; i < 3; ++i) EXPECT_EQ(outcome(sample_document(other)), PutOutcome::set_aside);
  EXPECT_EQ(find(1)->document, sample_document(1));
  const auto aside = store_->scans().set_aside_documents(0, 10);
  ASSERT_TRUE(aside.ok()) << aside.failure();
  ASSERT_EQ(aside->size(), 1U);
  EXPECT_EQ(aside->front().document, sample_document(other));
  EXPECT_NE(aside->front().why.find("kitchen-1"), std::string::npos) << aside->front().why;
  EXPECT_EQ(totals().counts.set_aside, 1);
}

TEST_F(ScanStoreTest, WhatCannotBeReadIsSetAsideAsItIs) {
  const std::string noise("\x00\xff{\"\n", 5);
  EXPECT_EQ(outcome(noise), PutOutcome::set_aside);
  EXPECT_EQ(outcome(noise), PutOutcome::set_aside);
  EXPECT_EQ(outcome(""), PutOutcome::set_aside);
  ASSERT_TRUE(store_->scans().set_aside("a record", "its check sum is wrong", at(7)).ok());
  reopen();
  const auto aside = store_->scans().set_aside_documents(0, 10);
  ASSERT_TRUE(aside.ok());
  ASSERT_EQ(aside->size(), 3U);
  EXPECT_EQ((*aside)[0].document, noise);
  EXPECT_EQ((*aside)[1].document, "");
  EXPECT_EQ((*aside)[2].why, "its check sum is wrong");
  EXPECT_EQ((*aside)[2].received, at(7));
  EXPECT_EQ(totals().counts.set_aside, 3);

  const auto rest = store_->scans().set_aside_documents((*aside)[0].number, 1);
  ASSERT_TRUE(rest.ok());
  ASSERT_EQ(rest->size(), 1U);
  EXPECT_EQ(rest->front().document, "");
  const auto discarded = store_->scans().discard_set_aside((*aside)[0].number);
  ASSERT_TRUE(discarded.ok());
  EXPECT_TRUE(*discarded);
  EXPECT_FALSE(*store_->scans().discard_set_aside((*aside)[0].number));
  EXPECT_EQ(totals().counts.set_aside, 2);
}

TEST_F(ScanStoreTest, TheLatestIsTheOneThatArrivedLast) {
  EXPECT_FALSE(*store_->scans().latest());
  put(sample_document(5));
  SampleScan old;  // by a clock that is ten years behind
  old.id = {"bakery", 3};
  old.taken_ms = kMorningMs - 3650LL * 24 * 3600 * 1000;
  put(sample_document(old), at(old.taken_ms));
  EXPECT_EQ((*store_->scans().latest())->id, old.id);
}

TEST_F(ScanStoreTest, NumbersReachToTheirEnd) {
  const std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  SampleScan sample;
  sample.id.number = last;
  sample.supersedes = ScanId{"kitchen", last - 1};
  put(sample_document(sample));
  put(sample_document(last - 1));
  EXPECT_EQ(find(last)->id.number, last);
  EXPECT_EQ(find(last)->supersedes, sample.supersedes);
  EXPECT_EQ(find(last - 1)->superseded_by, sample.id);
}

// Scans that supersede others, in any order of arrival, some of them twice: the same are booked.
TEST_F(ScanStoreTest, OneOfAChainIsBookedInWhateverOrderItArrives) {
  std::mt19937_64 random(random_seed());
  std::vector<std::string> documents;
  std::set<std::uint64_t> booked;
  for (std::uint64_t number = 1; number <= 40; ++number) {
    SampleScan sample;
    sample.id.number = number;
    if (number > 1 && random() % 2 == 0) sample.supersedes = ScanId{"kitchen", number - 1};
    if (sample.supersedes) booked.erase(number - 1);
    booked.insert(number);
    documents.push_back(sample_document(sample));
  }
  documents.insert(documents.end(), documents.begin(), documents.begin() + 20);
  std::shuffle(documents.begin(), documents.end(), random);
  for (const std::string& document : documents) {
    outcome(document);
    ASSERT_EQ(totals().counts.superseded, counted_anew().counts.superseded);
  }
  for (std::uint64_t number = 1; number <= 40; ++number) {
    EXPECT_EQ(!find(number)->superseded_by, booked.count(number) == 1) << number;
  }
  EXPECT_EQ(totals().counts.scans, 40);
  EXPECT_EQ(totals().counts.superseded, 40 - static_cast<std::int64_t>(booked.size()));
}

TEST_F(ScanStoreTest, TwoThatSupersedeOneAreBothBooked) {
  put(sample_document(1));
  for (const std::uint64_t number : {3U, 2U}) {
    SampleScan sample;
    sample.id.number = number;
    sample.supersedes = ScanId{"kitchen", 1};
    put(sample_document(sample));
  }
  EXPECT_EQ(find(1)->superseded_by, (ScanId{"kitchen", 3}));
  EXPECT_FALSE(find(2)->superseded_by || find(3)->superseded_by);
}

TEST_F(ScanStoreTest, TotalsFollowWhatIsStored) {
  std::int64_t bytes = 0;
  for (std::uint64_t number = 1; number <= 5; ++number) {
    put(sample_document(number), at(kMorningMs + static_cast<std::int64_t>(number)));
    bytes += static_cast<std::int64_t>(sample_document(number).size());
    ASSERT_EQ(totals().counts.scans, static_cast<std::int64_t>(number));
  }
  for (const StoreTotals& now : {totals(), counted_anew()}) {
    EXPECT_EQ(now.counts.scans, 5);
    EXPECT_EQ(now.counts.document_bytes, bytes);
    EXPECT_EQ(now.oldest_received_ms, kMorningMs + 1);
    EXPECT_EQ(now.newest_received_ms, kMorningMs + 5);
    EXPECT_GT(now.file_bytes, bytes);
    EXPECT_GE(now.free_bytes, 0);
  }
}

// Whatever is done, by whichever part of the store.
TEST_F(ScanStoreTest, CountsThatAreKeptAreThoseThatAreCounted) {
  std::mt19937_64 random(random_seed());
  options_ = options_for_work(folder_.path());
  reopen();
  totals();
  for (const WorkStep& step : sample_work(400, random)) {
    const Expected<void> done = do_step(*store_, step);
    ASSERT_TRUE(done.ok()) << done.failure();
    const ScanCounts kept = totals().counts;
    ASSERT_EQ(kept, counted_anew().counts) << kept.scans << " scans, " << static_cast<int>(step.kind);
  }
  EXPECT_GT(totals().counts.set_aside, 0);
}

}  // namespace
}  // namespace traygauge::test
