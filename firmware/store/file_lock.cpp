#include "firmware/store/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace traygauge {

Expected<FileLock> FileLock::take(const std::filesystem::path& file) {
  constexpr int kMode = 0600;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kMode);
  if (descriptor < 0) {
    return Failure{file.string() + ": the file cannot be made: " + std::strerror(errno) +
                   ". Check that the folder exists and that this user may write in it."};
  }
  FileLock lock(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return lock;
  if (errno == EWOULDBLOCK) {
    return Failure{file.string() + ": another hub uses this store. End it, or name another file."};
  }
  return Failure{file.string() + ": the file cannot be locked: " + std::strerror(errno)};
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace traygauge
