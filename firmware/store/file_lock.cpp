#include "firmware/store/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace traygauge {

Expected<FileLock> FileLock::take(const std::filesystem::path& file) {
  constexpr int kMode = 0600;
  FileDescriptor opened(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kMode));
  if (!opened.is_open()) {
    return Failure{file.string() + ": the file cannot be made: " + std::strerror(errno) +
                   ". Check that the folder exists and that this user may write in it."};
  }
  if (::flock(opened.number(), LOCK_EX | LOCK_NB) == 0) return FileLock(std::move(opened));
  if (errno == EWOULDBLOCK) {
    return Failure{file.string() + ": another hub uses this store. End it, or name another file."};
  }
  return Failure{file.string() + ": the file cannot be locked: " + std::strerror(errno)};
}

}  // namespace traygauge
