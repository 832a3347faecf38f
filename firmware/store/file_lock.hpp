// One process at a time.
#pragma once

#include <filesystem>
#include <utility>

#include "firmware/base/expected.hpp"
#include "firmware/base/file_descriptor.hpp"

namespace traygauge {

// Held as long as the object lives; a process that is killed releases it. The file stays behind, empty.
class FileLock {
 public:
  // Fails where another process holds it, or the folder cannot be written.
  static Expected<FileLock> take(const std::filesystem::path& file);

 private:
  explicit FileLock(FileDescriptor file) : file_(std::move(file)) {}
  FileDescriptor file_;
};

}  // namespace traygauge
