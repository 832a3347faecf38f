// What a scan costs the card that it is written to.
#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>

#include "tests/firmware/store/open_sample.hpp"

namespace traygauge::test {
namespace {

constexpr int kScans = 1000;
constexpr std::uint64_t kBudgetBytes = 32'768;

class BudgetTest : public StoreTest {};

void print(const char* what, const DiskCounters& before, const DiskCounters& after, double per) {
  const auto each = [&](std::uint64_t DiskCounters::*counter) {
    return static_cast<double>(after.*counter - before.*counter) / per;
  };
  std::cout << what << ": " << each(&DiskCounters::bytes_written) << " bytes in "
            << each(&DiskCounters::writes) << " writes, " << each(&DiskCounters::blocks_written)
            << " blocks of 4096 bytes, " << each(&DiskCounters::syncs) << " syncs" << std::endl;
}

TEST_F(BudgetTest, AScanWithItsDeliveriesIsBelowTheBudget) {
  options_.destinations = {"webhook", "broker"};
  reopen();
  std::int64_t document_bytes = 0;
  const DiskCounters start = store_->disk();
  for (std::uint64_t number = 1; number <= kScans; ++number) {
    const std::string document = sample_document(number);
    document_bytes += static_cast<std::int64_t>(document.size());
    put(document, at(kMorningMs + static_cast<std::int64_t>(number) * 60'000));
  }
  const DiskCounters stored = store_->disk();
  std::cout << "a document has " << document_bytes / kScans << " bytes" << std::endl;
  print("put", start, stored, kScans);
  EXPECT_LT(stored.bytes_written - start.bytes_written, kScans * kBudgetBytes);
  EXPECT_LE(stored.syncs - start.syncs, std::uint64_t{4 * kScans});

  for (std::int64_t seq = 1; seq <= kScans; ++seq) {
    ASSERT_TRUE(store_->deliveries().mark_delivered("webhook", std::vector<DeliveryKey>{{seq}}).ok());
  }
  const DiskCounters delivered = store_->disk();
  print("delivered, one by one", stored, delivered, kScans);
  std::vector<DeliveryKey> all;
  for (std::int64_t seq = 1; seq <= kScans; ++seq) all.push_back({seq});
  ASSERT_TRUE(store_->deliveries().mark_delivered("broker", all).ok());
  print("delivered, a thousand at a time", delivered, store_->disk(), kScans);
  const Expected<StoreTotals> totals = store_->scans().totals();
  ASSERT_TRUE(totals.ok()) << totals.failure();
  std::cout << "the file has " << totals->file_bytes / kScans << " bytes a scan" << std::endl;
}

TEST_F(BudgetTest, ReadingAndRepeatingWriteNothing) {
  put(sample_document(1));
  const DiskCounters before = store_->disk();
  for (int i = 0; i < 10; ++i) {
    const Expected<PutResult> again = store_->scans().put(sample_document(1), at(kMorningMs));
    ASSERT_TRUE(again.ok()) << again.failure();
    EXPECT_EQ(again->outcome, PutOutcome::already_stored);
    ASSERT_TRUE(store_->scans().latest().ok());
    ASSERT_TRUE(store_->history().page({}, 50).ok());
    ASSERT_TRUE(store_->scans().totals().ok());
  }
  EXPECT_EQ(store_->disk().bytes_written, before.bytes_written);
  EXPECT_EQ(store_->disk().syncs, before.syncs);
}

}  // namespace
}  // namespace traygauge::test
