#include "firmware/journal/lock_file.hpp"

#include <system_error>
#include <utility>

#include "firmware/journal/io_failure.hpp"

namespace traygauge {

Expected<std::unique_ptr<File>> lock_file(FileSystem& file_system, const std::string& path) {
  const std::string lock_path = path + ".lock";
  auto opened = file_system.open(lock_path, OpenMode::existing_or_new);
  if (!opened.ok()) return io_failure(lock_path, "this file could not be made", opened.error);
  const std::error_code error = opened.value->try_lock();
  if (error == std::errc::resource_unavailable_try_again) {
    return Failure{path + ": another process has this file open. Stop it, or name another file."};
  }
  if (error) return io_failure(lock_path, "this file could not be locked", error);
  return std::move(opened.value);
}

}  // namespace traygauge
