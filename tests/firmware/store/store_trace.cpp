#include "tests/firmware/store/store_trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/firmware/store/sample_scan.hpp"

namespace traygauge::test {

void StoreTrace::note(Store& store, const RecordedDisk& disk) {
  contents.push_back(content_of(store));
  confirmed_at.push_back(disk.operations().size());
}

std::size_t StoreTrace::confirmed_steps(std::size_t operation) const {
  const auto next = std::upper_bound(confirmed_at.begin(), confirmed_at.end(), operation);
  return next == confirmed_at.begin() ? 0 : static_cast<std::size_t>(next - confirmed_at.begin()) - 1;
}

std::vector<std::string> StoreTrace::allowed_contents(std::size_t operation) const {
  const std::size_t confirmed = confirmed_steps(operation);
  std::vector<std::string> allowed = {contents[confirmed]};
  if (confirmed + 1 < contents.size()) allowed.push_back(contents[confirmed + 1]);
  return allowed;
}

StoreTrace record_work(const MemoryFolder& folder, const DiskFiles& before,
                       const std::vector<WorkStep>& steps, const char* settings) {
  StoreTrace trace{before, {}, steps, {}, {}};
  write_files(folder.path(), before);
  RecordedDisk disk;
  StoreOptions options = options_for_work(folder.path());
  options.observer = &disk;
  Expected<OpenedStore> opened = open_store(options, at(kMorningMs));
  if (!opened.ok()) {
    ADD_FAILURE() << opened.failure();
    return trace;
  }
  Store& store = *opened->store;
  if (settings != nullptr) {
    const Expected<void> set = store.database().run_script("the test cannot set", settings);
    EXPECT_TRUE(set.ok()) << set.failure();
  }
  trace.note(store, disk);
  for (const WorkStep& step : steps) {
    const Expected<void> done = do_step(store, step);
    EXPECT_TRUE(done.ok()) << done.failure();
    trace.note(store, disk);
  }
  opened->store.reset();
  trace.operations = disk.operations();
  return trace;
}

std::string find_fault(const MemoryFolder& folder, const DiskFiles& files,
                       const std::vector<std::string>& allowed, RecordedDisk* disk) {
  write_files(folder.path(), files);
  StoreOptions options = options_for_work(folder.path());
  options.observer = disk;
  const Expected<OpenedStore> opened = open_store(options, at(kMorningMs));
  if (!opened.ok()) return opened.failure();
  if (!opened->notices.empty()) return opened->notices.front();
  const std::string content = content_of(*opened->store);
  if (std::find(allowed.begin(), allowed.end(), content) != allowed.end()) return {};
  return "found:\n" + content + "expected:\n" + allowed.front();
}

std::size_t crash_points() {
  constexpr std::size_t kByDefault = 1000;
  const char* const given = std::getenv("TRAYGAUGE_CRASH_POINTS");
  return given == nullptr ? kByDefault : std::strtoul(given, nullptr, 10);
}

}  // namespace traygauge::test
