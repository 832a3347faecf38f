// A disk that is full or fails: nothing is confirmed that is not there, and when it works again all goes on.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/recorded_disk.hpp"
#include "tests/firmware/store/sample_scan.hpp"
#include "tests/firmware/store/sample_work.hpp"
#include "tests/firmware/store/store_trace.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

constexpr std::size_t kFaultySteps = 8;

int error_of(const DiskOperation& operation, bool is_full) {
  switch (operation.action) {
    case DiskAction::create:
      return SQLITE_CANTOPEN;
    case DiskAction::write:
      return is_full ? SQLITE_FULL : SQLITE_IOERR_WRITE;
    case DiskAction::truncate:
      return SQLITE_IOERR_TRUNCATE;
    case DiskAction::sync:
      return SQLITE_IOERR_FSYNC;
    case DiskAction::remove:
      return SQLITE_IOERR_DELETE;
  }
  return SQLITE_IOERR;
}

// Fails at one operation, or from there on until it is mended.
class FaultyRun {
 public:
  FaultyRun(std::size_t fails_at, bool fails_on, bool is_full)
      : disk_([this, fails_at, fails_on, is_full](std::size_t index, const DiskOperation& operation) {
          const bool fails = !is_mended_ && (fails_on ? index >= fails_at : index == fails_at);
          has_failed_ = has_failed_ || fails;
          return fails ? error_of(operation, is_full) : SQLITE_OK;
        }) {}

  // Empty where the content was at each moment that of the steps that were confirmed.
  std::string work(const MemoryFolder& folder, const StoreTrace& sound) {
    write_files(folder.path(), {});
    StoreOptions options = options_for_work(folder.path());
    options.observer = &disk_;
    Expected<OpenedStore> opened = open_store(options, at(kMorningMs));
    if (!opened.ok()) {
      is_mended_ = true;
      if (opened.failure().find(options.file.string()) != 0) return "no sentence: " + opened.failure();
      opened = open_store(options, at(kMorningMs));
    }
    if (!opened.ok()) return "does not open when mended: " + opened.failure();
    if (!opened->notices.empty()) return opened->notices.front();
    trace_.note(*opened->store, disk_);
    for (std::size_t i = 0; i < sound.steps.size(); ++i) {
      if (const std::string fault = step(*opened->store, sound, i); !fault.empty()) return fault;
    }
    opened->store.reset();
    trace_.operations = disk_.operations();
    return find_fault(folder, read_files(folder.path()), {sound.contents.back()});
  }

  bool has_failed() const { return has_failed_; }
  const StoreTrace& trace() const { return trace_; }

 private:
  std::string step(Store& store, const StoreTrace& sound, std::size_t i) {
    const Expected<void> done = do_step(store, sound.steps[i]);
    if (!done.ok()) {
      is_mended_ = true;
      const std::string content = content_of(store);
      const bool is_there = content == sound.contents[i + 1];
      if (!is_there && content != sound.contents[i]) return "after '" + done.failure() + "':\n" + content;
      // What is there already is confirmed by whatever succeeds next: here by a change of nothing.
      const Expected<void> confirmed = is_there ? change_nothing(store) : do_step(store, sound.steps[i]);
      if (!confirmed.ok()) return "does not go on: " + confirmed.failure();
    }
    trace_.note(store, disk_);
    return trace_.contents.back() == sound.contents[i + 1] ? ""
                                                           : "confirmed, but:\n" + trace_.contents.back();
  }

  bool is_mended_ = false;
  bool has_failed_ = false;
  RecordedDisk disk_;
  StoreTrace trace_;
};

std::vector<WorkStep> work_for_faults(std::mt19937_64& random) {
  std::vector<WorkStep> steps = {{WorkStep::Kind::put, 500, 0}, {WorkStep::Kind::put, 501, 0}};
  for (const WorkStep& step : sample_work(kFaultySteps, random)) {
    if (step.number > 1) steps.push_back(step);
  }
  return steps;
}

TEST(StoreFault, EachOperationMayFailOnceOrForLong) {
  const MemoryFolder folder;
  std::mt19937_64 random(random_seed());
  const StoreTrace sound = record_work(folder, {}, work_for_faults(random));
  ASSERT_EQ(sound.contents.size(), sound.steps.size() + 1);
  for (const bool fails_on : {false, true}) {
    for (const bool is_full : {false, true}) {
      for (std::size_t i = 0; i < sound.operations.size(); ++i) {
        FaultyRun run(i, fails_on, is_full);
        ASSERT_EQ(run.work(folder, sound), "") << "operation " << i << (fails_on ? " and on" : "");
        ASSERT_TRUE(run.has_failed());
      }
    }
  }
}

// The power fails after the disk has failed.
TEST(StoreFault, WhatWasConfirmedAfterAFaultOutlivesAPowerCut) {
  constexpr int kCutsARun = 4;
  const MemoryFolder folder;
  std::mt19937_64 random(random_seed());
  std::size_t cuts = 0;
  while (cuts < crash_points() / 2) {
    const StoreTrace sound = record_work(folder, {}, work_for_faults(random));
    for (std::size_t i = random() % 3; i < sound.operations.size() && cuts < crash_points() / 2; i += 3) {
      FaultyRun run(i, random() % 2 == 0, random() % 2 == 0);
      ASSERT_EQ(run.work(folder, sound), "");
      const StoreTrace& trace = run.trace();
      for (int cut = 0; cut < kCutsARun; ++cut, ++cuts) {
        const std::size_t first = trace.confirmed_at.front();
        const std::size_t cut_at = first + random() % (trace.operations.size() - first + 1);
        UncertainDisk disk({});
        for (std::size_t k = 0; k < cut_at; ++k) disk.apply(trace.operations[k]);
        ASSERT_EQ(find_fault(folder, disk.after_power_cut(random), trace.allowed_contents(cut_at)), "")
            << "fault at " << i << ", cut at " << cut_at;
      }
    }
  }
}

TEST(StoreFault, AFullDiskIsToldInASentence) {
  const MemoryFolder folder;
  bool is_full = false;
  RecordedDisk disk([&](std::size_t, const DiskOperation& operation) {
    return is_full && operation.action == DiskAction::write ? SQLITE_FULL : SQLITE_OK;
  });
  StoreOptions options = options_for_work(folder.path());
  options.observer = &disk;
  Expected<OpenedStore> opened = open_store(options, at(kMorningMs));
  ASSERT_TRUE(opened.ok()) << opened.failure();
  is_full = true;
  const Expected<PutResult> put = opened->store->scans().put(sample_document(1), at(kMorningMs));
  ASSERT_FALSE(put.ok());
  for (const char* const part : {"results.db: scan kitchen-1 cannot be stored", "full", "Free some space"}) {
    EXPECT_NE(put.failure().find(part), std::string::npos) << put.failure();
  }
  EXPECT_FALSE(*opened->store->scans().find({"kitchen", 1}));
  EXPECT_FALSE(opened->store->is_damaged());
  EXPECT_EQ(opened->store->scans().totals()->counts.scans, 0);
  is_full = false;
  EXPECT_TRUE(opened->store->scans().put(sample_document(1), at(kMorningMs)).ok());
  EXPECT_EQ(opened->store->scans().totals()->counts.scans, 1);
}

// Nothing more fits on the disk, but what is there can be overwritten: old scans still make room.
TEST(StoreFault, RetentionFreesSpaceOnAFullDisk) {
  const MemoryFolder folder;
  bool is_full = false;
  StoreOptions options = options_for_work(folder.path());
  options.destinations = {};
  RecordedDisk disk([&](std::size_t, const DiskOperation& operation) {
    if (!is_full || operation.action != DiskAction::write) return SQLITE_OK;
    const auto end = static_cast<std::uintmax_t>(operation.offset) + operation.bytes.size();
    return end > std::filesystem::file_size(operation.path) ? SQLITE_FULL : SQLITE_OK;
  });
  options.observer = &disk;
  options.free_space = [](const std::filesystem::path&) -> Expected<std::int64_t> { return 0; };
  Expected<OpenedStore> opened = open_store(options, at(kMorningMs));
  ASSERT_TRUE(opened.ok()) << opened.failure();
  Store& store = *opened->store;
  for (std::uint64_t number = 1; number <= 300; ++number) {
    ASSERT_TRUE(store.scans().put(sample_document(number), at(kMorningMs)).ok());
  }
  is_full = true;
  ASSERT_FALSE(store.scans().put(sample_document(301), at(kMorningMs)).ok());
  RetentionRules rules;
  rules.keep_newest = 10;
  rules.min_free_bytes = 100'000;
  RetentionReport report;
  int calls = 0;
  do {
    const auto run = store.retention().run(rules, at(kMorningMs), std::chrono::steady_clock::time_point());
    ASSERT_TRUE(run.ok()) << run.failure();
    report = *run;
    ASSERT_LT(++calls, 100);
  } while (report.has_more);
  EXPECT_EQ(report.missing_bytes, 0);
  EXPECT_GT(store.scans().totals()->free_bytes, 100'000);
  EXPECT_TRUE(store.scans().put(sample_document(301), at(kMorningMs)).ok());
}

}  // namespace
}  // namespace traygauge::test
