#include "firmware/journal/scan_counter.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <tuple>

#include "core/base/little_endian.hpp"
#include "firmware/journal/posix_file_system.hpp"
#include "tests/firmware/journal/journal_disk.hpp"
#include "tests/support/power_cut.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

const std::string kTestCounter = "state/scans.counter";
constexpr std::size_t kBlockOfCounter = 4096;

std::unique_ptr<ScanCounter> open_counter(FileSystem& disk, std::uint64_t largest_known = 0) {
  auto opened = ScanCounter::open(disk, kTestCounter, largest_known);
  EXPECT_TRUE(opened.ok()) << (opened.ok() ? "" : opened.failure());
  return opened.ok() ? std::move(*opened) : nullptr;
}

std::uint64_t next_of(ScanCounter& counter) {
  const auto number = counter.next();
  EXPECT_TRUE(number.ok()) << (number.ok() ? "" : number.failure());
  return number.ok() ? *number : 0;
}

// Gives so many numbers; the last one.
std::uint64_t count_to(ScanCounter& counter, int scans) {
  std::uint64_t last = 0;
  for (int i = 0; i < scans; ++i) last = next_of(counter);
  return last;
}

TEST(ScanCounter, CountsFromOneWithoutGapsOverRestarts) {
  RecordedFileSystem disk;
  for (std::uint64_t start = 0; start < 10; ++start) {
    const auto counter = open_counter(disk);
    for (std::uint64_t i = 1; i <= 30; ++i) EXPECT_EQ(next_of(*counter), 30 * start + i);
    EXPECT_TRUE(counter->notice().empty());
  }
}

TEST(ScanCounter, LeavesOutWhatWasReservedWhenItWasKilled) {
  RecordedFileSystem disk;
  auto counter = open_counter(disk);
  EXPECT_EQ(count_to(*counter, 3), 3U);
  disk.kill_process();
  counter.reset();
  counter = open_counter(disk);
  EXPECT_EQ(next_of(*counter), 65U);
  EXPECT_TRUE(counter->notice().empty());
}

TEST(ScanCounter, WritesOnceFor64Scans) {
  RecordedFileSystem disk;
  const auto counter = open_counter(disk);
  const std::uint64_t written = disk.bytes_written();
  const std::size_t syncs = disk.sync_count();
  count_to(*counter, 640);
  EXPECT_EQ(disk.bytes_written() - written, 10 * 4096U);
  EXPECT_EQ(disk.sync_count() - syncs, 10U);
}

TEST(ScanCounter, GoesOnAfterANumberThatIsKnownElsewhere) {
  RecordedFileSystem disk;
  count_to(*open_counter(disk), 5);
  auto counter = open_counter(disk, 1000);
  EXPECT_EQ(next_of(*counter), 1001U);
  EXPECT_EQ(
      counter->notice(),
      "state/scans.counter: the counter of scans lagged behind scan 1000, which is known already. It goes on "
      "from there.");
  counter.reset();
  counter = open_counter(disk, 1001);
  EXPECT_EQ(next_of(*counter), 1002U);
  EXPECT_TRUE(counter->notice().empty());
}

// Each block of the file at each stage: no number comes back, however little the caller knows.
TEST(ScanCounter, OneDamagedBlockRepeatsNoNumber) {
  for (const int scans : {1, 64, 65, 128, 129, 200}) {
    for (const bool is_killed : {true, false}) {
      for (const std::size_t block : {0U, 1U}) {
        for (const std::uint64_t largest_known : {0U, 500U}) {
          RecordedFileSystem disk;
          auto counter = open_counter(disk);
          counter.reset();
          counter = open_counter(disk, largest_known);
          const std::uint64_t last = count_to(*counter, scans);
          if (is_killed) disk.kill_process();
          counter.reset();
          flip_bit(disk, block * kBlockOfCounter + 20, 3, kTestCounter);
          counter = open_counter(disk);
          const std::uint64_t next = next_of(*counter);
          EXPECT_GT(next, last) << scans << " scans, block " << block << ", known " << largest_known;
          EXPECT_LE(next, last + 2 * kNumbersReserved);
          EXPECT_NE(counter->notice().find("one of two blocks"), std::string::npos);
          counter.reset();
          EXPECT_TRUE(open_counter(disk)->notice().empty()) << "mended";
        }
      }
    }
  }
}

TEST(ScanCounter, AfterOneDamagedBlockTheOtherMayFollow) {
  RecordedFileSystem disk;
  count_to(*open_counter(disk), 300);
  std::uint64_t last = 300;
  for (const std::size_t block : {0U, 1U, 1U, 0U, 0U, 1U}) {
    flip_bit(disk, block * kBlockOfCounter + 20, 3, kTestCounter);
    auto counter = open_counter(disk);
    const std::uint64_t next = count_to(*counter, 1);
    EXPECT_GT(next, last);
    last = next;
    disk.kill_process();
    counter.reset();
  }
}

TEST(ScanCounter, AFileThatIsDamagedAsAWholeIsMovedAwayAndAMillionLeftOut) {
  const Bytes zeros(2 * kBlockOfCounter);
  for (const Bytes& damaged : {zeros, Bytes(), Bytes(100, std::byte{'x'})}) {
    RecordedFileSystem disk(DiskImage{{kTestCounter, damaged}});
    auto counter = open_counter(disk, 17);
    EXPECT_EQ(next_of(*counter), 1'000'018U);
    EXPECT_EQ(counter->notice(),
              "state/scans.counter: the counter of scans is damaged and was moved to "
              "state/scans.counter.damaged. A "
              "million numbers are left out, so that none is given twice. Check the disk or card.");
    EXPECT_EQ(file_on(disk, kTestCounter + ".damaged"), damaged);
    counter.reset();
    counter = open_counter(disk);
    EXPECT_EQ(next_of(*counter), 1'000'019U);
    EXPECT_TRUE(counter->notice().empty());
  }
}

TEST(ScanCounter, AFileThatVanishedLeavesAMillionOut) {
  RecordedFileSystem disk;
  auto counter = open_counter(disk, 17);
  EXPECT_EQ(next_of(*counter), 1'000'018U);
  EXPECT_NE(counter->notice().find("is absent although this station has scanned before"), std::string::npos);
}

// Killed between the two renames that follow damage.
TEST(ScanCounter, AKillWhileDamageIsMendedStartsNoSecondCount) {
  std::size_t call = 0;
  for (bool has_struck = true; has_struck; ++call) {
    ASSERT_LT(call, 100U);
    RecordedFileSystem disk(DiskImage{{kTestCounter, Bytes(2 * kBlockOfCounter)}});
    Fault fault;
    fault.calls_before = call;
    fault.kills_process = true;
    disk.set_fault(fault);
    std::ignore = ScanCounter::open(disk, kTestCounter, 0);
    has_struck = disk.fault_has_struck();
    disk.set_fault(std::nullopt);
    disk.kill_process();
    EXPECT_GT(next_of(*open_counter(disk)), 1'000'000U) << "call " << call;
  }
  EXPECT_GT(call, 10U);
}

// Killed at any call while the file is made; a power cut later loses its name, unless a start made it
// durable.
TEST(ScanCounter, AKillWhileItIsMadeAndAPowerCutRepeatNoNumber) {
  std::size_t call = 0;
  for (bool has_struck = true; has_struck; ++call) {
    ASSERT_LT(call, 100U);
    RecordedFileSystem disk;
    Fault fault;
    fault.calls_before = call;
    fault.kills_process = true;
    disk.set_fault(fault);
    std::ignore = ScanCounter::open(disk, kTestCounter, 0);
    has_struck = disk.fault_has_struck();
    disk.set_fault(std::nullopt);
    disk.kill_process();
    const auto counter = open_counter(disk);
    const std::uint64_t given = next_of(*counter);
    const PowerCut cut(disk, disk.operations().size());
    RecordedFileSystem left(cut.state([](std::size_t) { return false; }));
    EXPECT_GT(next_of(*open_counter(left)), given) << "call " << call;
  }
  EXPECT_GT(call, 8U);
}

TEST(ScanCounter, AFailingDiskIsToldAndRepeatsNoNumber) {
  RecordedFileSystem disk;
  const auto counter = open_counter(disk);
  EXPECT_EQ(count_to(*counter, 64), 64U);
  disk.set_fault(Fault{std::errc::no_space_on_device});
  EXPECT_EQ(failure_of(counter->next()),
            "state/scans.counter: the counter of scans could not be written: No space left on device. Free "
            "space on "
            "this disk.");
  EXPECT_EQ(next_of(*counter), 65U);
}

// As JournalError.AHeadWhoseSyncFailedCostsNotBothHeads.
TEST(ScanCounter, ABlockWhoseSyncFailedCostsNotBothBlocks) {
  RecordedFileSystem disk;
  auto counter = open_counter(disk);
  EXPECT_EQ(count_to(*counter, 64), 64U);
  disk.set_fault(Fault{std::errc::io_error, 1});  // after the write
  EXPECT_FALSE(counter->next().ok());
  disk.kill_process();
  counter.reset();
  const std::size_t restart = disk.operations().size();
  counter = open_counter(disk);
  count_to(*counter, 1);
  for (std::size_t moment = restart; moment <= disk.operations().size(); ++moment) {
    for (const std::size_t kept : {0U, 1U}) {
      RecordedFileSystem left(
          PowerCut(disk, moment).state([&](std::size_t choice) { return choice % 2 == kept; }));
      const auto reopened = open_counter(left);
      EXPECT_EQ(reopened->notice().find("million"), std::string::npos) << moment;
      EXPECT_GT(next_of(*reopened), 64U);
    }
  }
}

TEST(ScanCounter, BelongsToOneProcess) {
  RecordedFileSystem disk;
  const auto counter = open_counter(disk);
  EXPECT_EQ(failure_of(ScanCounter::open(disk, kTestCounter, 0)),
            "state/scans.counter: another process has this file open. Stop it, or name another file.");
}

TEST(ScanCounter, ACounterOfANewerProgramIsRefusedAndLeftAlone) {
  RecordedFileSystem disk;
  open_counter(disk);
  Bytes bytes = file_on(disk, kTestCounter);
  store_little_endian(std::span(bytes), 8, std::uint32_t{2});
  store_little_endian(std::span(bytes), kBlockOfCounter + 8, std::uint32_t{2});
  disk.overwrite(kTestCounter, bytes);
  EXPECT_EQ(failure_of(ScanCounter::open(disk, kTestCounter, 0)),
            "state/scans.counter: a newer program wrote this counter of scans. Install that program again.");
  EXPECT_EQ(file_on(disk, kTestCounter), bytes);
}

TEST(ScanCounter, EndsRatherThanBeginAgain) {
  RecordedFileSystem disk;
  open_counter(disk);
  const auto counter = open_counter(disk, std::numeric_limits<std::uint64_t>::max() - 2);
  EXPECT_EQ(next_of(*counter), std::numeric_limits<std::uint64_t>::max() - 1);
  EXPECT_EQ(next_of(*counter), std::numeric_limits<std::uint64_t>::max());
  EXPECT_NE(failure_of(counter->next()).find("is at its end"), std::string::npos);
}

TEST(ScanCounter, WorksOnARealDisk) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "scans.counter").string();
  for (std::uint64_t start = 0; start < 3; ++start) {
    auto counter = ScanCounter::open(posix_file_system(), path, 0);
    ASSERT_TRUE(counter.ok()) << counter.failure();
    for (std::uint64_t i = 1; i <= 70; ++i) EXPECT_EQ(next_of(**counter), 70 * start + i);
  }
}

}  // namespace
}  // namespace traygauge::test
