// Disks that refuse: at every single call, once and for good.
#include <gtest/gtest.h>

#include "firmware/journal/posix_file_system.hpp"
#include "tests/firmware/journal/journal_disk.hpp"
#include "tests/support/power_cut.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

constexpr std::size_t kMoreCallsThanAny = 1000;

// Three appends and a removal around a restart; what is stored is in `stored`.
void use_journal(RecordedFileSystem& disk, std::vector<std::string>& stored) {
  for (int start = 0; start < 2; ++start) {
    auto opened = Journal::open(disk, {kTestJournal, kTestJournalBytes});
    if (!opened.ok()) {
      EXPECT_EQ(opened.failure().find("state/results.journal"), 0U) << opened.failure();
      continue;
    }
    Journal& journal = **opened;
    for (int i = 0; i < 3; ++i) {
      const std::string payload = std::to_string(start) + "-" + std::to_string(i) + std::string(4100, 'x');
      const auto answer = journal.append(payload);
      if (answer.ok()) {
        stored.push_back(payload);
      } else {
        EXPECT_NE(answer.failure().find("could not be stored in the journal: "), std::string::npos)
            << answer.failure();
      }
    }
    const auto oldest = journal.oldest();
    if (!oldest.ok() || !oldest->has_value()) continue;
    EXPECT_TRUE(journal.remove_oldest((*oldest)->sequence).ok());
    // A record that was removed before the restart may have come back.
    if (!stored.empty() && stored.front() == (*oldest)->payload) stored.erase(stored.begin());
  }
}

// What an append refused must not be there, and what was removed may.
void expect_found(RecordedFileSystem& disk, const std::vector<std::string>& stored, std::size_t call) {
  const auto journal = open_test_journal(disk);
  ASSERT_NE(journal, nullptr);
  auto found = payloads_in(*journal);
  ASSERT_GE(found.size(), stored.size()) << "call " << call;
  found.erase(found.begin(), found.end() - static_cast<std::ptrdiff_t>(stored.size()));
  EXPECT_EQ(found, stored) << "call " << call;
  for (const JournalNotice& notice : journal->take_notices()) {
    EXPECT_NE(notice.kind, JournalNotice::Kind::damaged) << notice.text;
  }
  EXPECT_TRUE(journal->append("next").ok());
}

TEST(JournalError, NoCallThatFailsOnceLosesAnything) {
  for (const std::errc error : {std::errc::io_error, std::errc::no_space_on_device}) {
    std::size_t call = 0;
    for (; call < kMoreCallsThanAny; ++call) {
      RecordedFileSystem disk;
      std::vector<std::string> stored;
      disk.set_fault(Fault{error, call});
      use_journal(disk, stored);
      const bool has_struck = disk.fault_has_struck();
      disk.set_fault(std::nullopt);
      expect_found(disk, stored, call);
      if (!has_struck) break;
    }
    EXPECT_GT(call, 30U);
    EXPECT_LT(call, kMoreCallsThanAny);
  }
}

TEST(JournalError, NoDiskThatFailsFromSomeCallOnLosesAnything) {
  std::size_t call = 0;
  for (; call < kMoreCallsThanAny; ++call) {
    RecordedFileSystem disk;
    std::vector<std::string> stored;
    Fault fault{std::errc::io_error, call};
    fault.is_lasting = true;
    disk.set_fault(fault);
    use_journal(disk, stored);
    const bool has_struck = disk.fault_has_struck();
    disk.set_fault(std::nullopt);
    const auto journal = open_test_journal(disk);
    ASSERT_NE(journal, nullptr);
    const auto found = payloads_in(*journal);
    // An append that failed may be there: the disk did not let it be taken back.
    for (const std::string& payload : stored) {
      EXPECT_EQ(std::count(found.begin(), found.end(), payload), 1) << "call " << call;
    }
    if (!has_struck) break;
  }
  EXPECT_LT(call, kMoreCallsThanAny);
}

TEST(JournalError, AfterAFailedAppendTheNextOneIsInItsPlace) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  append_letters(*journal, {100});
  disk.set_fault(Fault{});
  EXPECT_EQ(
      failure_of(journal->append("refused")),
      "state/results.journal: the result could not be stored in the journal: Input/output error. Check the "
      "disk or card and replace it.");
  EXPECT_EQ(*journal->append("taken"), 2U);
  EXPECT_EQ(payloads_in(*journal), (std::vector<std::string>{std::string(100, 'a'), "taken"}));
}

// The kernel shows the head whose sync failed as whole. The next start must not write over the other one,
// which alone is on the disk, before this one is there.
TEST(JournalError, AHeadWhoseSyncFailedCostsNotBothHeads) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  append_letters(*journal, {100, 200});
  EXPECT_TRUE(journal->remove_oldest(1).ok());
  disk.set_fault(Fault{std::errc::io_error, 1});  // after the write
  journal.reset();
  ASSERT_TRUE(disk.fault_has_struck());
  const std::size_t restart = disk.operations().size();
  journal = open_test_journal(disk);
  for (std::size_t moment = restart; moment <= disk.operations().size(); ++moment) {
    for (const std::size_t kept : {0U, 1U}) {  // every other sector: whatever is in doubt is torn
      RecordedFileSystem left(
          PowerCut(disk, moment).state([&](std::size_t choice) { return choice % 2 == kept; }));
      const auto reopened = open_test_journal(left);
      ASSERT_NE(reopened, nullptr) << moment;
      EXPECT_EQ(payloads_in(*reopened).back(), std::string(200, 'b'));
    }
  }
}

// Killed between write and sync of an append: the kernel shows the record, a power cut may lose it. Nobody
// was promised it, so nothing may be told as damaged.
TEST(JournalError, AnAppendThatWasKilledBeforeItsSyncIsNoDamage) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  append_letters(*journal, {100});
  Fault fault;
  fault.calls_before = 1;
  fault.kills_process = true;
  disk.set_fault(fault);
  EXPECT_FALSE(journal->append(std::string(200, 'k')).ok());
  disk.set_fault(std::nullopt);
  journal.reset();
  const std::size_t restart = disk.operations().size();
  journal = open_test_journal(disk);
  EXPECT_EQ(journal->waiting_count(), 2U);
  for (std::size_t moment = restart; moment <= disk.operations().size(); ++moment) {
    const PowerCut cut(disk, moment);
    for (std::size_t lost = 0; lost <= cut.choice_count(); ++lost) {
      RecordedFileSystem left(cut.state([&](std::size_t choice) { return choice >= lost; }));
      const auto reopened = open_test_journal(left);
      EXPECT_EQ(payloads_in(*reopened).front(), std::string(100, 'a'));
      EXPECT_EQ(notice_among(reopened->take_notices(), JournalNotice::Kind::damaged).text, "") << moment;
    }
  }
}

TEST(JournalError, AReadThatFailsForGoodChangesNothing) {
  RecordedFileSystem disk;
  const auto journal = open_test_journal(disk);
  append_letters(*journal, {100});
  Fault fault;
  fault.is_lasting = true;
  disk.set_fault(fault);
  EXPECT_EQ(failure_of(journal->oldest()),
            "state/results.journal: a result could not be read from the journal: Input/output error. Check "
            "the disk "
            "or card and replace it.");
  disk.set_fault(std::nullopt);
  EXPECT_EQ((*journal->oldest())->payload, std::string(100, 'a'));
  EXPECT_TRUE(journal->take_notices().size() == 1) << "the journal was made, and nothing else";
}

TEST(JournalError, AReadOnlyDiskIsToldAtStartAndAtAnAppend) {
  RecordedFileSystem disk;
  auto journal = open_test_journal(disk);
  append_letters(*journal, {100});
  disk.set_read_only(true);
  EXPECT_EQ(failure_of(journal->append("x")),
            "state/results.journal: the result could not be stored in the journal: Read-only file system. "
            "The disk is "
            "mounted read-only, often after an error: check it and mount it for writing.");
  EXPECT_EQ(payloads_in(*journal), std::vector{std::string(100, 'a')});
  journal.reset();
  EXPECT_NE(failure_of(Journal::open(disk, {kTestJournal, kTestJournalBytes})).find("Read-only file system"),
            std::string::npos);
  disk.set_read_only(false);
  EXPECT_EQ(payloads_in(*open_test_journal(disk)), std::vector{std::string(100, 'a')});
}

TEST(JournalError, AnAbsentFolderIsNamed) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "absent" / "results.journal").string();
  EXPECT_EQ(failure_of(Journal::open(posix_file_system(), {path, kTestJournalBytes})),
            path +
                ".lock: this file could not be made: No such file or directory. Make the folder, or correct "
                "the path.");
}

}  // namespace
}  // namespace traygauge::test
