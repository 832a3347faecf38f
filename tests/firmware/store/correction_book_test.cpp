#include "firmware/store/correction_book.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/store/open_sample.hpp"

namespace traygauge::test {
namespace {

const ScanId kScan{"kitchen", 1};

class CorrectionBookTest : public StoreTest {
 protected:
  BookedCorrection add(const CorrectionAction& action, const std::string& author = "chef") {
    const auto booked = store_->corrections().add(kScan, action, author, "seen on the tray", at(kMorningMs));
    EXPECT_TRUE(booked.ok()) << booked.failure();
    return booked.ok() ? *booked : BookedCorrection();
  }
  StoredScan stored() { return store_->scans().find(kScan)->value(); }
};

TEST_F(CorrectionBookTest, KeepsWhoSaidWhatWhenAndWhy) {
  put(sample_document(1));
  EXPECT_EQ(add(RenameItem{2, "bulgur"}).refusal, "");
  EXPECT_EQ(add(MergeItems{2, {3}}, "second chef").number, 2);
  reopen();
  const auto list = store_->corrections().list(kScan);
  ASSERT_TRUE(list.ok()) << list.failure();
  ASSERT_EQ(list->size(), 2U);
  EXPECT_EQ((*list)[0].author, "chef");
  EXPECT_EQ((*list)[0].reason, "seen on the tray");
  EXPECT_EQ((*list)[0].made, at(kMorningMs));
  EXPECT_EQ((*list)[0].action, CorrectionAction(RenameItem{2, "bulgur"}));
  EXPECT_EQ((*list)[1].author, "second chef");
  const auto corrected = store_->corrections().corrected(kScan);
  ASSERT_TRUE(corrected.ok() && *corrected);
  EXPECT_EQ((*corrected)->items.size(), 3U);
  EXPECT_EQ((*corrected)->items[0].food, "bulgur");
  EXPECT_EQ(stored().document, sample_document(1)) << "the measurement stays as it came";
}

TEST_F(CorrectionBookTest, UndoIsAddedAndTakesMarksBack) {
  put(sample_document(1));
  const int number = add(MarkItemWrong{2}).number;
  EXPECT_TRUE(stored().is_corrected && stored().is_wrong);
  EXPECT_EQ(store_->scans().totals()->counts.wrong, 1);
  const BookedCorrection undone = add(UndoCorrection{number});
  EXPECT_EQ(undone.refusal, "");
  EXPECT_FALSE(undone.scan.is_corrected);
  EXPECT_FALSE(stored().is_corrected || stored().is_wrong);
  EXPECT_EQ(store_->scans().totals()->counts.wrong, 0);
  EXPECT_EQ(store_->corrections().list(kScan)->size(), 2U);
  // Numbers go on, so that labels of parts are never given twice.
  ASSERT_EQ(add(SplitItem{2, 10.0, "peas"}).number, 3);
  EXPECT_EQ((*store_->corrections().corrected(kScan))->items[1].label, kSplitLabelBase + 3);
}

TEST_F(CorrectionBookTest, ARefusalWritesNothing) {
  put(sample_document(1));
  add(RenameItem{2, "bulgur"});
  const std::uint64_t bytes = store_->disk().bytes_written;
  EXPECT_NE(add(RenameItem{99, "bulgur"}).refusal, "");
  EXPECT_NE(add(RenameItem{2, "bulgur"}, "").refusal, "");
  EXPECT_NE(add(RenameItem{2, "bulgur"}, "a\nb").refusal, "");
  EXPECT_NE(add(UndoCorrection{7}).refusal, "");
  EXPECT_EQ(add(RenameItem{99, "bulgur"}).scan.items[0].food, "bulgur") << "the scan as it is";
  EXPECT_EQ(store_->disk().bytes_written, bytes);
  const auto missing = store_->corrections().add({"kitchen", 2}, MarkScanWrong{}, "chef", "", at(kMorningMs));
  ASSERT_TRUE(missing.ok());
  EXPECT_NE(missing->refusal.find("kitchen-2"), std::string::npos);
  EXPECT_FALSE(*store_->corrections().corrected({"kitchen", 2}));
  EXPECT_TRUE(store_->corrections().list({"kitchen", 2})->empty());
}

TEST_F(CorrectionBookTest, TheNumberOfCorrectionsIsBounded) {
  put(sample_document(1));
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(add(RenameItem{2, "food " + std::to_string(i)}).refusal, "");
  EXPECT_NE(add(RenameItem{2, "one more"}).refusal, "");
}

}  // namespace
}  // namespace traygauge::test
