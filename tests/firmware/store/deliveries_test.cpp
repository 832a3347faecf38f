#include "firmware/store/deliveries.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/store/open_sample.hpp"

namespace traygauge::test {
namespace {

using Seqs = std::vector<std::int64_t>;
using Keys = std::vector<DeliveryKey>;
using std::chrono::seconds;

class DeliveriesTest : public StoreTest {
 protected:
  void SetUp() override {
    options_.destinations = {"webhook", "broker"};
    StoreTest::SetUp();
  }
  Seqs due(const std::string& destination, std::int64_t now_ms = kMorningMs, std::size_t max = 100) {
    const auto pending = store_->deliveries().due(destination, now_ms, max);
    EXPECT_TRUE(pending.ok()) << pending.failure();
    Seqs seqs;
    for (const PendingDelivery& delivery : *pending) seqs.push_back(delivery.key.place);
    return seqs;
  }
  void fail(std::int64_t seq, std::int64_t now_ms, seconds wait, const std::string& why = "refused") {
    const auto noted = store_->deliveries().mark_failed("webhook", {seq}, now_ms, wait, why);
    EXPECT_TRUE(noted.ok()) << noted.failure();
  }
};

TEST_F(DeliveriesTest, EachScanWaitsForEachDestinationUntilItWasTold) {
  for (std::uint64_t number = 1; number <= 3; ++number) put(sample_document(number));
  ASSERT_TRUE(store_->scans().put(sample_document(2), at(kMorningMs)).ok());
  EXPECT_EQ(due("webhook"), (Seqs{1, 2, 3}));
  EXPECT_EQ(due("webhook", kMorningMs, 2), (Seqs{1, 2}));
  ASSERT_TRUE(store_->deliveries().mark_delivered("webhook", Keys{{1}, {3}, {77}}).ok());
  reopen();
  EXPECT_EQ(due("webhook"), (Seqs{2}));
  EXPECT_EQ(due("broker"), (Seqs{1, 2, 3}));
  EXPECT_EQ(due("nobody"), Seqs{});
  EXPECT_EQ(*store_->deliveries().waiting_for(1), std::vector<std::string>{"broker"});
  EXPECT_EQ(*store_->deliveries().waiting_for(2), (std::vector<std::string>{"broker", "webhook"}));
  // The document again does not bring back what was told.
  ASSERT_TRUE(store_->scans().put(sample_document(1), at(kMorningMs)).ok());
  EXPECT_EQ(due("webhook"), (Seqs{2}));
  const auto pending = store_->deliveries().due("webhook", kMorningMs, 1);
  EXPECT_EQ(pending->front().id, (ScanId{"kitchen", 2}));
  EXPECT_EQ(pending->front().id, (ScanId{"kitchen", 2}));
}

TEST_F(DeliveriesTest, AFailedAttemptWaits) {
  put(sample_document(1));
  put(sample_document(2));
  fail(1, kMorningMs, seconds(30));
  fail(1, kMorningMs, seconds(30), "no route" + std::string(600, '\xc3'));
  EXPECT_EQ(due("webhook"), (Seqs{2}));
  EXPECT_EQ(due("webhook", kMorningMs + 29'999), (Seqs{2}));
  EXPECT_EQ(due("webhook", kMorningMs + 30'000), (Seqs{1, 2}));
  const auto pending = store_->deliveries().due("webhook", kMorningMs + 30'000, 1);
  EXPECT_EQ(pending->front().attempts, 2);
  EXPECT_EQ(pending->front().last_failure.substr(0, 8), "no route");
  EXPECT_LE(pending->front().last_failure.size(), 500U);
  EXPECT_EQ(due("broker"), (Seqs{1, 2}));
}

TEST_F(DeliveriesTest, AClockThatJumpsTenYearsHoldsNothingBack) {
  constexpr std::int64_t kTenYearsMs = 3650LL * 24 * 3600 * 1000;
  put(sample_document(1));
  fail(1, kMorningMs + kTenYearsMs, std::chrono::hours(24));
  EXPECT_EQ(due("webhook", kMorningMs + kTenYearsMs + 1000), Seqs{});
  EXPECT_EQ(due("webhook", kMorningMs), (Seqs{1}));
  fail(1, kMorningMs, std::chrono::hours(1000));
  EXPECT_EQ(due("webhook", kMorningMs + 24 * 3'600'000), (Seqs{1})) << "no wait is longer than a day";
  EXPECT_EQ(due("webhook", kMorningMs + kTenYearsMs), (Seqs{1}));
}

TEST_F(DeliveriesTest, CorrectionsWaitInTheOrderOfWhatHappened) {
  const auto correct = [&](std::uint64_t number, std::int64_t made_ms) {
    const auto booked =
        store_->corrections().add({"kitchen", number}, RenameItem{2, "bulgur"}, "chef", "", at(made_ms));
    ASSERT_TRUE(booked.ok()) << booked.failure();
    ASSERT_EQ(booked->refusal, "");
  };
  put(sample_document(1));
  put(sample_document(2));
  correct(1, kMorningMs + 5);
  correct(2, kMorningMs + 6);
  correct(1, kMorningMs + 7);
  put(sample_document(3));
  correct(3, kMorningMs + 8);
  const auto told = [&] {
    std::string text;
    const auto due = store_->deliveries().due("webhook", kMorningMs, 100);
    for (const PendingDelivery& delivery : *due)
      text += std::to_string(delivery.id.number) + "." + std::to_string(delivery.correction) + " ";
    return text;
  };
  EXPECT_EQ(told(), "1.0 2.0 1.1 2.1 1.2 3.0 3.1 ");
  EXPECT_EQ((*store_->deliveries().due("webhook", kMorningMs, 5))[4].correction_ms, kMorningMs + 7);
  ASSERT_TRUE(store_->deliveries().mark_delivered("webhook", Keys{{1}, {2}, {2, 2}}).ok());
  reopen();
  EXPECT_EQ(told(), "1.1 1.2 3.0 3.1 ");
  ASSERT_TRUE(store_->deliveries().abandon("broker").ok());
  EXPECT_EQ(*store_->deliveries().waiting_for(1), std::vector<std::string>{"webhook"});
  EXPECT_EQ(*store_->deliveries().waiting_for(2), std::vector<std::string>());
}

TEST_F(DeliveriesTest, SaysWhichDestinationsAreNew) {
  const std::vector<std::string> names{"till", "webhook"};
  EXPECT_EQ(*store_->deliveries().configure(names), std::vector<std::string>{"till"});
  EXPECT_EQ(*store_->deliveries().configure(names), std::vector<std::string>());
}

TEST_F(DeliveriesTest, CountsWhatWaits) {
  put(sample_document(1), at(kMorningMs + 1));
  put(sample_document(2), at(kMorningMs + 2));
  ASSERT_TRUE(store_->deliveries().mark_delivered("broker", Keys{{1}, {2}}).ok());
  ASSERT_TRUE(store_->deliveries().mark_delivered("webhook", Keys{{1}}).ok());
  const auto states = store_->deliveries().states();
  ASSERT_TRUE(states.ok()) << states.failure();
  ASSERT_EQ(states->size(), 2U);
  EXPECT_EQ((*states)[0].name, "broker");
  EXPECT_EQ((*states)[0].pending, 0);
  EXPECT_EQ((*states)[0].oldest_received_ms, std::nullopt);
  EXPECT_EQ((*states)[1].pending, 1);
  EXPECT_EQ((*states)[1].oldest_received_ms, kMorningMs + 2);
}

TEST_F(DeliveriesTest, ADestinationThatIsGoneKeepsWhatWaitsUntilItIsAbandoned) {
  put(sample_document(1));
  options_.destinations = {"broker", "broker", "till"};
  reopen();
  put(sample_document(2));
  EXPECT_EQ(due("webhook"), (Seqs{1}));
  EXPECT_EQ(due("broker"), (Seqs{1, 2}));
  EXPECT_EQ(due("till"), (Seqs{2}));
  ASSERT_EQ(store_->deliveries().states()->size(), 3U);
  EXPECT_FALSE((*store_->deliveries().states())[2].is_configured);
  EXPECT_EQ(*store_->deliveries().abandon("webhook"), 1);
  EXPECT_EQ(store_->deliveries().states()->size(), 2U);
  EXPECT_EQ(due("webhook"), Seqs{});
  EXPECT_EQ(due("broker"), (Seqs{1, 2}));
}

}  // namespace
}  // namespace traygauge::test
