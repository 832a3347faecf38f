// Power cuts at every operation on the disk: what the store confirmed is there, once, and nothing is damaged.
#include <gtest/gtest.h>

#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/recorded_disk.hpp"
#include "tests/firmware/store/sample_work.hpp"
#include "tests/firmware/store/store_trace.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

constexpr std::size_t kSteps = 20;

// Another power cut while the store recovers from the first.
std::string cut_recovery(const MemoryFolder& folder, const DiskFiles& files,
                         const std::vector<std::string>& allowed, std::mt19937_64& random) {
  RecordedDisk recovery;
  std::string fault = find_fault(folder, files, allowed, &recovery);
  if (!fault.empty() || recovery.operations().empty()) return fault;
  UncertainDisk disk(files);
  const std::size_t cut = random() % (recovery.operations().size() + 1);
  for (std::size_t i = 0; i < cut; ++i) disk.apply(recovery.operations()[i]);
  return find_fault(folder, disk.after_power_cut(random), allowed);
}

// Cuts once at each operation, until `points` are used up. Gives the faults, a few at most.
std::vector<std::string> cut_everywhere(const MemoryFolder& folder, const StoreTrace& trace,
                                        std::size_t& points, std::mt19937_64& random) {
  constexpr std::size_t kMaxFaults = 3;
  constexpr std::uint64_t kOneInSoMany = 4;
  std::vector<std::string> faults;
  UncertainDisk disk(trace.before);
  for (std::size_t i = 0; i <= trace.operations.size() && points > 0 && faults.size() < kMaxFaults; ++i) {
    const std::vector<std::string> allowed = trace.allowed_contents(i);
    const DiskFiles files = disk.after_power_cut(random);
    --points;
    std::string fault = random() % kOneInSoMany == 0 ? cut_recovery(folder, files, allowed, random)
                                                     : find_fault(folder, files, allowed);
    if (!fault.empty()) faults.push_back("cut before operation " + std::to_string(i) + ": " + fault);
    if (i < trace.operations.size()) disk.apply(trace.operations[i]);
  }
  return faults;
}

TEST(StoreCrash, APowerCutTakesNothingThatWasConfirmed) {
  const MemoryFolder folder;
  std::mt19937_64 random(random_seed());
  const std::size_t wanted = crash_points();
  std::size_t traces = 0;
  for (std::size_t points = wanted; points > 0; ++traces) {
    const StoreTrace trace = record_work(folder, {}, sample_work(kSteps, random));
    ASSERT_EQ(trace.contents.size(), kSteps + 1);
    for (const std::string& fault : cut_everywhere(folder, trace, points, random)) ADD_FAILURE() << fault;
    if (HasFailure()) return;
  }
  std::cout << wanted << " power cuts in " << traces << " runs of " << kSteps << " steps" << std::endl;
}

// Any, or the worst: when the journal's header is zero and not yet synced, which is the last thing a step
// does.
std::size_t moment_to_kill(const StoreTrace& trace, std::mt19937_64& random) {
  const std::size_t opened_at = trace.confirmed_at.front();
  const std::size_t confirmed_at = trace.confirmed_at[random() % trace.confirmed_at.size()];
  if (random() % 2 == 0 && confirmed_at > opened_at) return confirmed_at - 1;
  return opened_at + random() % (trace.operations.size() - opened_at + 1);
}

// The process is killed, which leaves all that it wrote in memory; the next one confirms the scan under way,
// goes on, and then the power is cut.
std::string kill_and_cut(const MemoryFolder& folder, const StoreTrace& trace, std::mt19937_64& random) {
  const std::size_t killed_at = moment_to_kill(trace, random);
  const std::size_t confirmed = trace.confirmed_steps(killed_at);
  UncertainDisk disk(trace.before);
  for (std::size_t i = 0; i < killed_at; ++i) disk.apply(trace.operations[i]);
  std::vector<WorkStep> next;
  if (confirmed < trace.steps.size()) next.push_back(trace.steps[confirmed]);
  next.push_back({WorkStep::Kind::put, 1000, 0});
  next.push_back({WorkStep::Kind::put, 1001, 0});
  const StoreTrace after = record_work(folder, disk.in_memory(), next);
  if (after.contents.size() != next.size() + 1) return "the next process failed";
  const std::size_t cut_at = random() % (after.operations.size() + 1);
  for (std::size_t i = 0; i < cut_at; ++i) disk.apply(after.operations[i]);
  std::vector<std::string> allowed = after.allowed_contents(cut_at);
  if (after.confirmed_steps(cut_at) == 0) {
    const std::vector<std::string> earlier = trace.allowed_contents(killed_at);
    allowed.insert(allowed.end(), earlier.begin(), earlier.end());
  }
  const std::string fault = find_fault(folder, disk.after_power_cut(random), allowed);
  if (fault.empty()) return {};
  return "killed before operation " + std::to_string(killed_at) +
         ", cut before the next process' operation " + std::to_string(cut_at) + ": " + fault;
}

TEST(StoreCrash, APowerCutAfterTheProcessWasKilledTakesNothing) {
  constexpr std::size_t kCutsATrace = 100;
  const MemoryFolder folder;
  std::mt19937_64 random(random_seed());
  const std::size_t wanted = crash_points() / 4;
  for (std::size_t done = 0; done < wanted; done += kCutsATrace) {
    const StoreTrace trace = record_work(folder, {}, sample_work(kSteps, random));
    ASSERT_EQ(trace.contents.size(), kSteps + 1);
    for (std::size_t i = 0; i < kCutsATrace; ++i) {
      ASSERT_EQ(kill_and_cut(folder, trace, random), "");
    }
  }
}

// The test of the test: settings that are not safe are found out.
TEST(StoreCrash, UnsafeSettingsAreFoundOut) {
  const MemoryFolder folder;
  std::mt19937_64 random(random_seed());
  for (const char* const settings : {"PRAGMA journal_mode = DELETE; PRAGMA locking_mode = NORMAL;"
                                     "SELECT count(*) FROM scans;",
                                     "PRAGMA synchronous = NORMAL", "PRAGMA synchronous = OFF"}) {
    std::size_t faults = 0;
    for (int run = 0; run < 10 && faults == 0; ++run) {
      std::size_t points = 1000;
      const StoreTrace trace = record_work(folder, {}, sample_work(kSteps, random), settings);
      faults = cut_everywhere(folder, trace, points, random).size();
    }
    EXPECT_GT(faults, 0U) << settings;
  }
}

}  // namespace
}  // namespace traygauge::test
