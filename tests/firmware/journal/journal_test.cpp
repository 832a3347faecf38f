#include "firmware/journal/journal.hpp"

#include <gtest/gtest.h>

#include <iostream>

#include "firmware/journal/posix_file_system.hpp"
#include "tests/firmware/journal/journal_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

TEST(Journal, GivesBackInOrderWhatWasAppended) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  const auto nothing = journal->oldest();
  ASSERT_TRUE(nothing.ok());
  EXPECT_FALSE(nothing->has_value());
  const auto payloads = append_letters(*journal, {3, 0, 4048, 4049, 9000});
  EXPECT_EQ(payloads_in(*journal), payloads);
  EXPECT_EQ(journal->waiting_count(), 5U);
  EXPECT_EQ(journal->waiting_bytes(), 3U + 4048 + 4049 + 9000);
  EXPECT_EQ((*journal->oldest())->sequence, 1U);
  EXPECT_EQ(journal->next_sequence(), 6U);
}

TEST(Journal, RemovesTheOldestAlone) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  append_letters(*journal, {1, 2, 3});
  EXPECT_EQ(failure_of(journal->remove_oldest(2)),
            "state/results.journal: record 2 is not the oldest one, which is 1; nothing was removed.");
  EXPECT_TRUE(journal->remove_oldest(1).ok());
  EXPECT_TRUE(journal->remove_oldest(1).ok()) << "a second confirmation does no harm";
  EXPECT_EQ(payloads_in(*journal), (std::vector<std::string>{"bb", "ccc"}));
  EXPECT_EQ(journal->waiting_bytes(), 5U);
  EXPECT_TRUE(journal->remove_oldest(2).ok());
  EXPECT_TRUE(journal->remove_oldest(3).ok());
  EXPECT_EQ(journal->waiting_count(), 0U);
  EXPECT_FALSE(journal->remove_oldest(4).ok());
}

TEST(Journal, KeepsWhatWaitsOverARestart) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  const auto payloads = append_letters(*journal, {10, 5000, 20});
  EXPECT_TRUE(journal->remove_oldest(1).ok());
  journal.reset();
  journal = open_test_journal(disk);
  EXPECT_EQ(payloads_in(*journal), (std::vector<std::string>{payloads[1], payloads[2]}));
  EXPECT_EQ(*journal->append("next"), 4U);
  EXPECT_TRUE(journal->take_notices().empty());
}

TEST(Journal, IsFullWithAnAnswerAndGoesOnWhenThereIsRoom) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  EXPECT_EQ(journal->free_blocks(), 14U);
  const auto payloads = append_letters(*journal, {4000, 4000, 12000, 12000, 12000, 8000, 4000});
  EXPECT_EQ(journal->free_blocks(), 0U);
  EXPECT_FALSE(journal->has_room(0));
  EXPECT_EQ(
      failure_of(journal->append("x")),
      "state/results.journal: the journal is full: 7 results wait for the hub. Start the hub, or give the "
      "journal more room.");
  EXPECT_EQ(payloads_in(*journal), payloads);
  EXPECT_TRUE(journal->remove_oldest(1).ok());
  EXPECT_TRUE(journal->has_room(4048));
  EXPECT_FALSE(journal->has_room(4049));
  EXPECT_FALSE(journal->append(std::string(4049, 'y')).ok());
  EXPECT_EQ(*journal->append("x"), 8U);
  EXPECT_EQ(payloads_in(*journal).back(), "x");
}

TEST(Journal, RefusesARecordThatIsTooLargeForIt) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  EXPECT_FALSE(journal->has_room(kMaxPayloadBytes + 1));
  EXPECT_EQ(failure_of(journal->append(std::string(kMaxPayloadBytes + 1, 'x'))),
            "state/results.journal: a result of 65537 bytes is too large for this journal, which takes up to "
            "56672.");
  EXPECT_TRUE(journal->append(std::string(56672, 'x')).ok());
}

TEST(Journal, TheLargestPayloadFits) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk, 32 * kBlockBytes);
  const std::string largest(kMaxPayloadBytes, 'x');
  ASSERT_TRUE(journal->append(largest).ok());
  EXPECT_EQ(payloads_in(*journal), std::vector{largest});
}

TEST(Journal, GoesRoundForever) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  for (std::uint64_t i = 1; i <= 200; ++i) {
    const std::string payload(i * 37 % 9000, static_cast<char>('a' + i % 26));
    ASSERT_EQ(*journal->append(payload), i);
    EXPECT_EQ((*journal->oldest())->payload, payload);
    EXPECT_TRUE(journal->remove_oldest(i).ok());
    if (i % 17 != 0) continue;
    journal.reset();
    journal = open_test_journal(disk);
    EXPECT_EQ(journal->waiting_count(), 0U);
  }
  EXPECT_EQ(file_on(disk).size(), kTestJournalBytes);
}

// No payload is taken for a block, whatever bytes it has.
TEST(Journal, APayloadMayBeAJournal) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  append_letters(*journal, {100, 200});
  const Bytes bytes = file_on(disk);
  std::string payload;
  for (std::size_t i = 0; i < 10 * kBlockBytes; ++i) payload.push_back(static_cast<char>(bytes[i]));
  ASSERT_TRUE(journal->append(payload).ok());
  journal.reset();
  journal = open_test_journal(disk);
  EXPECT_EQ(payloads_in(*journal),
            (std::vector<std::string>{std::string(100, 'a'), std::string(200, 'b'), payload}));
  EXPECT_TRUE(journal->take_notices().empty());
}

TEST(Journal, BelongsToOneProcess) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  EXPECT_EQ(failure_of(Journal::open(disk, {kTestJournal, kTestJournalBytes})),
            "state/results.journal: another process has this file open. Stop it, or name another file.");
  disk.kill_process();
  EXPECT_TRUE(Journal::open(disk, {kTestJournal, kTestJournalBytes}).ok());
}

TEST(Journal, WorksOnARealDisk) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "results.journal").string();
  auto journal = Journal::open(posix_file_system(), {path, kTestJournalBytes});
  ASSERT_TRUE(journal.ok()) << journal.failure();
  const auto payloads = append_letters(**journal, {10, 5000});
  EXPECT_NE(failure_of(Journal::open(posix_file_system(), {path, kTestJournalBytes})).find(path),
            std::string::npos);
  *journal = nullptr;
  journal = Journal::open(posix_file_system(), {path, 2 * kTestJournalBytes});
  ASSERT_TRUE(journal.ok()) << journal.failure();
  EXPECT_EQ(payloads_in(**journal), payloads);
  EXPECT_EQ(std::filesystem::file_size(path), 2 * kTestJournalBytes);
}

struct Cost {
  std::uint64_t bytes = 0;
  std::size_t syncs = 0;
};

// A scan's result is appended, and removed when the hub has it.
Cost cost_of_scans(std::size_t payload_bytes, int scans) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  const Cost before{disk.bytes_written(), disk.sync_count()};
  for (int i = 0; i < scans; ++i) {
    const auto stored = journal->append(std::string(payload_bytes, 'x'));
    EXPECT_TRUE(stored.ok());
    EXPECT_TRUE(journal->remove_oldest(*stored).ok());
  }
  return {disk.bytes_written() - before.bytes, disk.sync_count() - before.syncs};
}

TEST(Journal, AScanCostsItsBlocksAndOneSync) {
  constexpr int kScans = 1000;
  for (const auto& [payload_bytes, blocks] :
       {std::pair<std::size_t, std::size_t>{2000, 1}, {4048, 1}, {8000, 2}}) {
    const Cost cost = cost_of_scans(payload_bytes, kScans);
    EXPECT_EQ(cost.bytes, kScans * blocks * kBlockBytes);
    EXPECT_EQ(cost.syncs, std::size_t{kScans});
    std::cout << "a scan of " << payload_bytes << " bytes: " << cost.bytes / kScans << " bytes written, "
              << static_cast<double>(cost.syncs) / kScans << " syncs" << std::endl;
  }
}

}  // namespace
}  // namespace traygauge::test
