// SQLite's way to the disk, counted: cards wear out by what is written to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "firmware/base/expected.hpp"

namespace traygauge {

struct DiskCounters {
  std::uint64_t writes = 0;
  std::uint64_t bytes_written = 0;
  // Of 4,096 bytes, as a file system writes them: a block counts once between two syncs of its file.
  std::uint64_t blocks_written = 0;
  std::uint64_t syncs = 0;
};

enum class DiskAction { create, write, truncate, sync, remove };

struct DiskOperation {
  DiskAction action = DiskAction::sync;
  std::string_view path;
  std::int64_t offset = 0;             // of a write
  std::span<const std::byte> bytes{};  // of a write
  std::int64_t size = 0;               // after truncation
  bool syncs_folder = false;           // of a removal
};

// Sees each operation before it happens. For tests: power cuts and faults.
class DiskObserver {
 public:
  virtual ~DiskObserver() = default;
  // 0 (SQLITE_OK) lets the operation happen. Another result code of SQLite is returned in its place.
  virtual int before(const DiskOperation& operation) = 0;
};

// Registered with SQLite as long as it lives; it has to outlive the connections that use it. It offers
// neither shared memory nor memory-mapped files. Use from one thread.
class ObservedVfs {
 public:
  static Expected<std::unique_ptr<ObservedVfs>> create(DiskObserver* observer = nullptr);
  ObservedVfs(const ObservedVfs&) = delete;
  ObservedVfs& operator=(const ObservedVfs&) = delete;
  ~ObservedVfs();

  const char* name() const;
  const DiskCounters& counters() const;
  // Called after every 256th read, until it is replaced by null.
  void watch_reads(std::function<void()> on_reads);

  struct Parts;  // of the source

 private:
  explicit ObservedVfs(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace traygauge
