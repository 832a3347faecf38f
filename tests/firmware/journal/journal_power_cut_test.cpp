// Power cuts at every operation of random runs, with every kind of loss; see power_cut.hpp.
#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "tests/firmware/journal/journal_run.hpp"
#include "tests/support/power_cut.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

struct Examined {
  std::size_t points = 0;
  std::size_t points_with_choice = 0;
  std::size_t runs = 0;
  std::size_t records = 0;
};

// One sampled state for each operation of the run; from some of them a second run starts, and is cut, too.
void cut_everywhere(const RecordedFileSystem& disk, const RunHistory& history, std::mt19937& random,
                    int depth, Examined& examined) {
  for (std::size_t moment = 0; moment <= disk.operations().size(); ++moment) {
    const PowerCut cut(disk, moment);
    RecordedFileSystem left(cut.sample(random));
    ++examined.points;
    if (cut.choice_count() > 0) ++examined.points_with_choice;
    RunHistory waiting = check_after_cut(left, history, moment);
    if (testing::Test::HasFailure()) {
      std::cout << "cut after operation " << moment << " of " << disk.operations().size() << ", depth "
                << depth << std::endl;
      return;
    }
    constexpr std::size_t kOneIn = 8;
    if (depth > 0 || random() % kOneIn != 0) continue;
    // From here on as if the machine had been started on this state.
    RecordedFileSystem again(left.image());
    JournalRun run(again, random, std::move(waiting));
    run.take_steps(6);
    run.stop();
    cut_everywhere(again, run.history(), random, depth + 1, examined);
    if (testing::Test::HasFailure()) return;
  }
}

void print(const char* what, const Examined& examined) {
  std::cout << what << ": " << examined.points << " crash points (" << examined.points_with_choice
            << " with unsynced changes) of " << examined.runs << " runs, " << examined.records
            << " records stored" << std::endl;
}

TEST(JournalPowerCut, EveryStoredRecordIsFoundOnceAndNoNumberIsRepeated) {
  std::mt19937 random(random_seed());
  Examined examined;
  for (const std::size_t wanted = crash_points(2000); examined.points < wanted;) {
    RecordedFileSystem disk;
    JournalRun run(disk, random);
    run.take_steps(60);
    run.stop();
    ++examined.runs;
    examined.records += run.acknowledged_count();
    cut_everywhere(disk, run.history(), random, 0, examined);
    ASSERT_FALSE(HasFailure());
  }
  print("power cuts", examined);
}

Fault random_fault(std::mt19937& random) {
  Fault fault;
  fault.error = random() % 2 == 0 ? std::errc::io_error : std::errc::no_space_on_device;
  fault.calls_before = random() % 60;
  fault.is_lasting = random() % 4 == 0;
  fault.spares_reads = random() % 2 == 0;
  fault.tears_writes = random() % 2 == 0;
  return fault;
}

// Errors, once or from some call on; or kill -9 in the midst of any call.
void examine_faults(const char* what, bool kills_process) {
  std::mt19937 random(random_seed());
  Examined examined;
  for (const std::size_t wanted = crash_points(2000) / 2; examined.points < wanted;) {
    RecordedFileSystem disk;
    JournalRun run(disk, random);
    for (int part = 0; part < 4; ++part) {
      Fault fault = random_fault(random);
      fault.kills_process = kills_process;
      disk.set_fault(fault);
      run.take_steps(15);
      if (kills_process) run.kill();
      disk.set_fault(std::nullopt);
    }
    run.stop();
    ++examined.runs;
    examined.records += run.acknowledged_count();
    cut_everywhere(disk, run.history(), random, 0, examined);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  print(what, examined);
}

TEST(JournalPowerCut, NothingIsLostOnADiskThatFails) {
  examine_faults("power cuts after errors", false);
}

TEST(JournalPowerCut, NothingIsLostWhereTheProcessIsKilledInACall) {
  examine_faults("power cuts after kill -9", true);
}

}  // namespace
}  // namespace traygauge::test
