// What a store does to its disk, recorded; and the disks that a power cut may leave of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "firmware/store/observed_vfs.hpp"

namespace traygauge::test {

using FileBytes = std::vector<std::byte>;
using DiskFiles = std::map<std::string, FileBytes>;  // by name, without folder

DiskFiles read_files(const std::filesystem::path& folder);
void write_files(const std::filesystem::path& folder, const DiskFiles& files);

struct RecordedOperation {
  DiskAction action = DiskAction::sync;
  std::string name;
  std::int64_t offset = 0;
  FileBytes bytes;
  std::int64_t size = 0;
  bool syncs_folder = false;
  bool failed = false;  // of a sync
};

class RecordedDisk : public DiskObserver {
 public:
  // What `fail` returns for an operation, which it counts from 0, takes its place; it may be empty. Of what
  // fails only syncs are recorded.
  explicit RecordedDisk(std::function<int(std::size_t, const DiskOperation&)> fail = {})
      : fail_(std::move(fail)) {}
  int before(const DiskOperation& operation) override;

  const std::vector<RecordedOperation>& operations() const { return operations_; }
  std::size_t asked() const { return asked_; }

 private:
  std::function<int(std::size_t, const DiskOperation&)> fail_;
  std::vector<RecordedOperation> operations_;
  std::size_t asked_ = 0;
};

// The same disk as memory and platter see it. Sectors of 512 bytes are written whole or not at all; of what
// was not synced each may be there or not, in any combination, and so may sizes, creations and removals.
class UncertainDisk {
 public:
  explicit UncertainDisk(const DiskFiles& synced);
  void apply(const RecordedOperation& operation);

  // After a process was killed: all that it wrote.
  DiskFiles in_memory() const;
  // After a power cut: one of the possible disks.
  DiskFiles after_power_cut(std::mt19937_64& random) const;

 private:
  struct Change {
    bool is_truncation = false;
    std::int64_t offset = 0;  // or the size after truncation
    FileBytes bytes;
  };
  struct Inode {
    FileBytes memory;
    FileBytes synced;
    std::vector<Change> unsynced;
    bool syncs_folder = false;  // SQLite syncs the folder with a new journal
  };
  using Entry = std::shared_ptr<Inode>;  // null: no such file

  void sync_folder();
  static void change(FileBytes& file, const Change& change);
  static FileBytes apply_all(const Inode& inode);
  static FileBytes apply_some(const Inode& inode, std::mt19937_64& random);

  // What the folder says of a name: as it was synced, and after each change since.
  std::map<std::string, std::vector<Entry>> names_;
};

}  // namespace traygauge::test
