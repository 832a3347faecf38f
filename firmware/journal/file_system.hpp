// What the journal needs of a disk, so that tests can put one in its place that fails and loses power.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <system_error>

namespace traygauge {

// A value, or the system's error code (generic category); the caller knows the context and writes the
// sentence.
template <class T>
struct [[nodiscard]] IoResult {
  T value{};
  std::error_code error;
  bool ok() const { return !error; }
};

// An open file; it closes, and lets go of its lock, with the object.
class File {
 public:
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  virtual ~File() = default;

  // Fills `into`; fewer bytes only where the file ends.
  virtual IoResult<std::size_t> read_at(std::uint64_t offset_bytes, std::span<std::byte> into) = 0;
  // All of it or an error; after an error any part of it may be in the file. The file grows as needed.
  [[nodiscard]] virtual std::error_code write_at(std::uint64_t offset_bytes,
                                                 std::span<const std::byte> bytes) = 0;
  virtual IoResult<std::uint64_t> size_bytes() = 0;
  // Takes room on the disk for the first `bytes` and lets the file grow to them with zeros.
  // errc::operation_not_supported where the file system cannot.
  [[nodiscard]] virtual std::error_code reserve(std::uint64_t bytes) = 0;
  // What was written, and the file's size, outlast a power cut. After an error nothing is known of what was
  // written since the last sync: writing it anew is the only remedy.
  [[nodiscard]] virtual std::error_code sync_data() = 0;
  // For this object alone; errc::resource_unavailable_try_again where another one holds the lock.
  [[nodiscard]] virtual std::error_code try_lock() = 0;

 protected:
  File() = default;
};

enum class OpenMode {
  existing,  // errc::no_such_file_or_directory where it is absent
  existing_or_new,
  emptied,  // new, or cut to no bytes
};

class FileSystem {
 public:
  FileSystem(const FileSystem&) = delete;
  FileSystem& operator=(const FileSystem&) = delete;
  virtual ~FileSystem() = default;

  // For reading and writing; new files are readable by their owner alone.
  virtual IoResult<std::unique_ptr<File>> open(const std::string& path, OpenMode mode) = 0;
  // Replaces `to` in one step.
  [[nodiscard]] virtual std::error_code rename(const std::string& from, const std::string& to) = 0;
  [[nodiscard]] virtual std::error_code remove(const std::string& path) = 0;
  // New, renamed and removed names in the folder of `path` outlast a power cut.
  [[nodiscard]] virtual std::error_code sync_folder_of(const std::string& path) = 0;
  // Differs from every other one, to tell files apart.
  virtual IoResult<std::uint64_t> unique_number() = 0;

 protected:
  FileSystem() = default;
};

}  // namespace traygauge
