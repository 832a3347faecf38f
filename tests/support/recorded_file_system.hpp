// A disk in memory that records what is written and synced, and fails when told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware/journal/file_system.hpp"

namespace traygauge::test {

using Bytes = std::vector<std::byte>;
using DiskImage = std::map<std::string, Bytes>;  // by path

// Files by number, and which of them have names.
struct DiskContents {
  std::vector<Bytes> files;
  std::map<std::string, std::size_t> names;

  DiskImage image() const;
};

// A change in the order in which the program made it. Files have numbers, because names change.
struct RecordedOperation {
  enum class Kind { write, resize, sync_file, set_names, sync_folder };
  Kind kind = Kind::write;
  std::size_t file = 0;
  std::uint64_t offset_bytes = 0;
  Bytes bytes;
  std::uint64_t size_bytes = 0;  // of the file after a write or resize
  // Set in one step; without a number the name is gone.
  std::vector<std::pair<std::string, std::optional<std::size_t>>> names;
  std::string folder;
  bool failed = false;  // of syncs: what was written to a file before is in doubt for good, as on Linux
};

// Of a call to the disk.
struct Fault {
  std::errc error = std::errc::io_error;
  std::size_t calls_before = 0;  // that still succeed
  bool is_lasting = false;       // else one call fails
  bool spares_reads = false;     // only calls that change the disk count and fail
  bool tears_writes = true;      // a write that fails has written its first half, else nothing
  bool kills_process = false;    // kill -9 in this call; every later one fails until the fault is taken away
};

class RecordedFileSystem : public FileSystem {
 public:
  RecordedFileSystem() = default;
  explicit RecordedFileSystem(const DiskImage& image);  // durable

  IoResult<std::unique_ptr<File>> open(const std::string& path, OpenMode mode) override;
  std::error_code rename(const std::string& from, const std::string& to) override;
  std::error_code remove(const std::string& path) override;
  std::error_code sync_folder_of(const std::string& path) override;
  IoResult<std::uint64_t> unique_number() override;

  // What a power cut finds; see power_cut.hpp.
  const DiskContents& initial_contents() const { return initial_; }
  const std::vector<RecordedOperation>& operations() const { return operations_; }
  // The kernel's view of now.
  DiskImage image() const { return contents().image(); }
  // Behind the program's back and durable: damage by the medium, a file copied here. Recording begins anew.
  void overwrite(const std::string& path, Bytes bytes);

  // kill -9: files that are open are dead and unlocked, and what their objects do later changes nothing.
  void kill_process();
  void set_fault(std::optional<Fault> fault) {
    fault_ = fault;
    fault_has_struck_ = false;
  }
  bool has_fault() const { return fault_.has_value(); }
  bool fault_has_struck() const { return fault_has_struck_; }  // since it was set
  void set_read_only(bool is_read_only) { is_read_only_ = is_read_only; }
  // By which all files together may grow.
  void set_free_bytes(std::uint64_t bytes) { free_bytes_ = bytes; }

  std::uint64_t bytes_written() const { return bytes_written_; }
  std::size_t sync_count() const { return sync_count_; }

 private:
  friend class RecordedFile;
  struct Node {
    Bytes bytes;
    const void* lock_owner = nullptr;
  };

  DiskContents contents() const;
  std::error_code strike(bool is_change);
  std::error_code grow(std::size_t file, std::uint64_t size_bytes);
  std::error_code write(std::size_t file, std::uint64_t offset_bytes, std::span<const std::byte> bytes);
  std::error_code resize(std::size_t file, std::uint64_t size_bytes);
  void store(std::size_t file, std::uint64_t offset_bytes, std::span<const std::byte> bytes);
  void set_names(std::vector<std::pair<std::string, std::optional<std::size_t>>> names);

  DiskContents initial_;
  std::vector<Node> nodes_;
  std::map<std::string, std::size_t> names_;
  std::vector<RecordedOperation> operations_;
  std::size_t process_ = 0;
  std::optional<Fault> fault_;
  bool fault_has_struck_ = false;
  bool is_read_only_ = false;
  std::uint64_t free_bytes_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t bytes_written_ = 0;
  std::size_t sync_count_ = 0;
  std::uint64_t last_number_ = 0;
};

// "a/b" is in "a", "b" in "".
std::string folder_of_path(std::string_view path);

}  // namespace traygauge::test
