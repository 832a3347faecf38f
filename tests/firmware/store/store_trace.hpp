// A hub's work on a store, with the operations on the disk that it took; and stores that are opened after a
// crash.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/firmware/store/memory_folder.hpp"
#include "tests/firmware/store/recorded_disk.hpp"
#include "tests/firmware/store/sample_work.hpp"

namespace traygauge::test {

struct StoreTrace {
  DiskFiles before;
  std::vector<RecordedOperation> operations;
  std::vector<WorkStep> steps;
  // contents[k] after k steps, and the operations that had happened when that was confirmed. The first is
  // that of the store when it was opened.
  std::vector<std::string> contents;
  std::vector<std::size_t> confirmed_at;

  void note(Store& store, const RecordedDisk& disk);
  // How many steps were confirmed when so many operations had happened.
  std::size_t confirmed_steps(std::size_t operation) const;
  // What a store may hold after a power cut there: another step may have been under way.
  std::vector<std::string> allowed_contents(std::size_t operation) const;
};

// Does all steps; one that fails fails the test. `settings` may be null.
StoreTrace record_work(const MemoryFolder& folder, const DiskFiles& before,
                       const std::vector<WorkStep>& steps, const char* settings = nullptr);

// What is wrong with a store that is opened on these files; empty where its content is one of those allowed.
std::string find_fault(const MemoryFolder& folder, const DiskFiles& files,
                       const std::vector<std::string>& allowed, RecordedDisk* disk = nullptr);

// TRAYGAUGE_CRASH_POINTS, or 1,000.
std::size_t crash_points();

}  // namespace traygauge::test
