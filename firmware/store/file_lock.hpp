// One process at a time.
#pragma once

#include <filesystem>

#include "firmware/base/expected.hpp"

namespace traygauge {

// Held as long as the object lives; a process that is killed releases it. The file stays behind, empty.
class FileLock {
 public:
  // Fails where another process holds it, or the folder cannot be written.
  static Expected<FileLock> take(const std::filesystem::path& file);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace traygauge
