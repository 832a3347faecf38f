#include "firmware/support/durable_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <set>
#include <system_error>

#include "firmware/base/file_descriptor.hpp"

namespace traygauge {
namespace {

std::string reason_of(int error) {
  return std::system_category().message(error);
}

Failure unwritable(const std::filesystem::path& file, int error) {
  std::string text = file.string();
  text.append(": cannot be written: ").append(reason_of(error));
  return Failure{text};
}

std::filesystem::path folder_of_file(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

std::filesystem::path draft_of(const std::filesystem::path& file) {
  return folder_of_file(file) / ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".new");
}

Expected<void> write_draft(const FileToWrite& file) {
  std::error_code error;
  std::filesystem::create_directories(folder_of_file(file.path), error);
  if (error) return unwritable(folder_of_file(file.path), error.value());
  // 0600 until all is written: what may be secret is never open to others, not for a moment.
  const FileDescriptor draft(
      ::open(draft_of(file.path).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (!draft.is_open()) return unwritable(file.path, errno);
  if (!write_all(draft.number(), file.content) || ::fchmod(draft.number(), file.mode) != 0 ||
      ::fsync(draft.number()) != 0) {
    return unwritable(file.path, errno);
  }
  return {};
}

// Some file systems do not know how to rename without replacing; there, the look before has to do.
bool give_name(const std::filesystem::path& draft, const std::filesystem::path& file, IfThere if_there) {
  if (if_there == IfThere::refuse) {
    if (::renameat2(AT_FDCWD, draft.c_str(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS) return false;
    struct stat found {};
    if (::lstat(file.c_str(), &found) == 0) {
      errno = EEXIST;
      return false;
    }
  }
  return ::rename(draft.c_str(), file.c_str()) == 0;
}

// The folders that get a new folder, because `folder` is missing.
void add_missing_parents(std::filesystem::path folder, std::set<std::filesystem::path>& parents) {
  std::error_code ignored;
  while (!std::filesystem::exists(folder, ignored)) {
    parents.insert(folder_of_file(folder));
    folder = folder_of_file(folder);
  }
}

bool sync_names(const std::filesystem::path& folder) {
  const FileDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.is_open() && ::fsync(opened.number()) == 0;
}

}  // namespace

Expected<void> write_files(const std::vector<FileToWrite>& files, IfThere if_there) {
  Expected<void> result;
  std::set<std::filesystem::path> folders;
  for (const FileToWrite& file : files) {
    add_missing_parents(folder_of_file(file.path), folders);
    result = write_draft(file);
    if (!result.ok()) break;
  }
  for (const FileToWrite& file : files) {
    if (!result.ok()) break;
    if (!give_name(draft_of(file.path), file.path, if_there)) result = unwritable(file.path, errno);
    folders.insert(folder_of_file(file.path));
  }
  for (const std::filesystem::path& folder : folders) {
    if (result.ok() && !sync_names(folder)) result = unwritable(folder, errno);
  }
  if (!result.ok()) {
    for (const FileToWrite& file : files) ::unlink(draft_of(file.path).c_str());
  }
  return result;
}

Expected<void> check_archive_place(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder_of_file(file), ignored)) return unwritable(file, ENOENT);
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return {};
  const Failure other{file.string() +
                      ": cannot be written: something that is no archive stands there; name another file"};
  if (!S_ISREG(found.st_mode)) return other;
  const FileDescriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  std::array<char, 2> begin{};
  const bool is_gzip = opened.is_open() && ::read(opened.number(), begin.data(), begin.size()) == 2 &&
                       begin[0] == '\x1f' && begin[1] == '\x8b';
  if (!is_gzip && found.st_size != 0) return other;
  return {};
}

Expected<std::string> read_file(const std::filesystem::path& file, std::size_t max_bytes) {
  const auto fail = [&file](const std::string& reason) { return Failure{file.string() + ": " + reason}; };
  // A pipe must not stop the command.
  const FileDescriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!opened.is_open()) return fail("cannot be read: " + reason_of(errno));
  struct stat found {};
  if (::fstat(opened.number(), &found) != 0 || !S_ISREG(found.st_mode))
    return fail("expected a regular file");
  if (static_cast<std::size_t>(found.st_size) > max_bytes)
    return fail("expected at most " + std::to_string(max_bytes) + " bytes");
  std::string content(static_cast<std::size_t>(found.st_size), '\0');
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t count = ::read(opened.number(), content.data() + done, content.size() - done);
    if (count == 0) break;
    if (count < 0 && errno != EINTR) return fail("cannot be read: " + reason_of(errno));
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  content.resize(done);
  return content;
}

}  // namespace traygauge
