// Journals of another size than configured, and files that are none.
#include <gtest/gtest.h>

#include "core/base/little_endian.hpp"
#include "firmware/journal/journal_creation.hpp"
#include "tests/firmware/journal/journal_disk.hpp"

namespace traygauge::test {
namespace {

using Kind = JournalNotice::Kind;

TEST(JournalSize, IsTakenFromTheDiskWhenTheJournalIsMade) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk, kTestJournalBytes + 100);
  EXPECT_EQ(file_on(disk).size(), kTestJournalBytes);
  EXPECT_GE(disk.bytes_written(), kTestJournalBytes) << "each block once, not only reserved";
  EXPECT_EQ(notice_among(journal->take_notices(), Kind::created).text,
            "state/results.journal: a new journal was made here.");
  disk.set_free_bytes(0);
  append_letters(*journal, {4000, 12000, 12000, 12000, 12000, 4000});
  EXPECT_EQ(journal->free_blocks(), 0U);
}

TEST(JournalSize, IsRefusedWhereItIsNoSize) {
  RecordedFileSystem disk;
  EXPECT_EQ(failure_of(Journal::open(disk, {kTestJournal, kMinJournalBytes - 1})),
            "state/results.journal: a journal has 32768 to 1073741824 bytes, not 32767.");
  EXPECT_FALSE(Journal::open(disk, {kTestJournal, kMaxJournalBytes + 1}).ok());
  EXPECT_TRUE(disk.image().empty());
}

TEST(JournalSize, GrowsAndShrinksWithWhatWaits) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  const auto payloads = append_letters(*journal, {100, 5000, 9000, 100});
  EXPECT_TRUE(journal->remove_oldest(1).ok());
  const std::vector<std::string> waiting(payloads.begin() + 1, payloads.end());
  for (const std::uint64_t blocks : {32U, 8U, 16U}) {
    journal.reset();
    journal = open_test_journal(disk, blocks * kBlockBytes);
    EXPECT_EQ(file_on(disk).size(), blocks * kBlockBytes);
    EXPECT_EQ(payloads_in(*journal), waiting);
    EXPECT_EQ((*journal->oldest())->sequence, 2U);
    EXPECT_EQ(journal->next_sequence(), 5U);
    EXPECT_FALSE(notice_among(journal->take_notices(), Kind::resized).text.empty());
  }
  EXPECT_FALSE(disk.image().contains(unfinished_path(kTestJournal)));
}

TEST(JournalSize, IsKeptWhereWhatWaitsDoesNotFit) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  const auto payloads = append_letters(*journal, {9000, 9000, 4000});
  journal.reset();
  journal = open_test_journal(disk, kMinJournalBytes);
  EXPECT_EQ(journal->file_bytes(), kTestJournalBytes);
  EXPECT_EQ(payloads_in(*journal), payloads);
  EXPECT_EQ(
      notice_among(journal->take_notices(), Kind::size_kept).text,
      "state/results.journal: what waits does not fit into the configured 0.03 MiB. The journal keeps its "
      "0.06 MiB until a start at which it fits.");
  EXPECT_TRUE(journal->remove_oldest(1).ok());
  journal.reset();
  journal = open_test_journal(disk, kMinJournalBytes);
  EXPECT_EQ(journal->file_bytes(), kMinJournalBytes);
  EXPECT_EQ(payloads_in(*journal), (std::vector<std::string>{payloads[1], payloads[2]}));
}

TEST(JournalSize, IsKeptWhereTheDiskIsFull) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  const auto payloads = append_letters(*journal, {9000, 100});
  journal.reset();
  disk.set_free_bytes(kTestJournalBytes);
  journal = open_test_journal(disk, 2 * kTestJournalBytes);
  EXPECT_EQ(journal->file_bytes(), kTestJournalBytes);
  EXPECT_EQ(payloads_in(*journal), payloads);
  EXPECT_EQ(
      notice_among(journal->take_notices(), Kind::size_kept).text,
      "state/results.journal.new: the journal of 0.12 MiB could not be made: No space left on device. Free "
      "space on this disk. The journal keeps its 0.06 MiB.");
  EXPECT_FALSE(disk.image().contains(unfinished_path(kTestJournal)));
}

TEST(JournalSize, AFileThatWasCutOffIsMadeWholeWithWhatIsLeft) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  const auto payloads = append_letters(*journal, {100, 5000, 9000});
  journal.reset();
  Bytes bytes = file_on(disk);
  bytes.resize(byte_of_block(5));  // within the third record, whose blocks are 3, 4 and 5
  disk.overwrite(kTestJournal, bytes);
  journal = open_test_journal(disk);
  EXPECT_EQ(payloads_in(*journal), (std::vector<std::string>{payloads[0], payloads[1]}));
  EXPECT_EQ(file_on(disk).size(), kTestJournalBytes);
  const auto notices = journal->take_notices();
  EXPECT_FALSE(notice_among(notices, Kind::cut_off).text.empty());
  // The newer head went with the end: the older one does not know that the third record was whole.
  EXPECT_EQ(notice_among(notices, Kind::interrupted).first_sequence, 3U);
  EXPECT_TRUE(journal->append("next").ok());
}

TEST(JournalSize, WhatAKilledStartLeftIsTakenAway) {
  RecordedFileSystem disk(DiskImage{{unfinished_path(kTestJournal), Bytes(5000)}});
  auto journal = open_test_journal(disk);
  EXPECT_FALSE(disk.image().contains(unfinished_path(kTestJournal)));
  journal.reset();
  disk.overwrite(unfinished_path(kTestJournal), Bytes(5000));
  journal = open_test_journal(disk);
  EXPECT_FALSE(disk.image().contains(unfinished_path(kTestJournal)));
}

TEST(JournalSize, AnEmptyFileBecomesAJournal) {
  RecordedFileSystem disk(DiskImage{{kTestJournal, {}}});
  const auto journal = open_test_journal(disk);
  EXPECT_NE(notice_among(journal->take_notices(), Kind::created).text.find("the file was empty"),
            std::string::npos);
  EXPECT_TRUE(journal->append("x").ok());
}

TEST(JournalSize, AForeignFileIsRefusedAndLeftAlone) {
  for (const std::size_t bytes : {1U, 4096U, 8192U, 65536U, 65537U}) {
    const Bytes foreign(bytes, std::byte{'#'});
    RecordedFileSystem disk(DiskImage{{kTestJournal, foreign}});
    EXPECT_EQ(
        failure_of(Journal::open(disk, {kTestJournal, kTestJournalBytes})),
        "state/results.journal: this file is not a journal of Traygauge. Correct the path, or move the file "
        "away; it was not changed.");
    EXPECT_EQ(file_on(disk), foreign);
  }
}

TEST(JournalSize, AJournalOfANewerProgramIsRefusedAndLeftAlone) {
  RecordedFileSystem disk;
  append_letters(*open_test_journal(disk), {100});
  Bytes bytes = file_on(disk);
  constexpr std::size_t kVersionAt = 8;
  store_little_endian(std::span(bytes), kVersionAt, std::uint32_t{2});
  store_little_endian(std::span(bytes), kTestJournalBytes - kBlockBytes + kVersionAt, std::uint32_t{2});
  disk.overwrite(kTestJournal, bytes);
  EXPECT_EQ(failure_of(Journal::open(disk, {kTestJournal, kTestJournalBytes})),
            "state/results.journal: a newer program wrote this journal. Install that program again, or move "
            "the file "
            "away; results that wait in it then stay there.");
  EXPECT_EQ(file_on(disk), bytes);
}

}  // namespace
}  // namespace traygauge::test
