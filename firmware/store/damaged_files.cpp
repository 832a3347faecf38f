#include "firmware/store/damaged_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

#include "firmware/base/file_descriptor.hpp"
#include "firmware/base/wall_clock.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".damaged-";
// What SQLite keeps beside a file. The file itself goes first: a journal without its file is harmless.
constexpr auto kSuffixes = std::to_array<std::string_view>({"", "-journal", "-wal", "-shm"});

bool is_beside(std::string_view name) {
  return std::any_of(kSuffixes.begin() + 1, kSuffixes.end(),
                     [&](std::string_view suffix) { return name.ends_with(suffix); });
}

fs::path with(const fs::path& file, std::string_view suffix) {
  return file.string() + std::string(suffix);
}

// "2026-11-27T07:40:12.345Z" as "20261127T074012Z": no character that other file systems refuse.
std::string time_for_name(std::int64_t now_ms) {
  constexpr std::size_t kToSeconds = 19;
  std::string text = utc_text(now_ms).substr(0, kToSeconds);
  std::erase_if(text, [](char character) { return character == '-' || character == ':'; });
  return text + "Z";
}

fs::path free_name(const fs::path& file, std::int64_t now_ms) {
  const std::string name = file.string() + std::string(kMark) + time_for_name(now_ms);
  std::error_code ignored;
  fs::path aside = name;
  for (int i = 2; fs::exists(aside, ignored); ++i) aside = name + "-" + std::to_string(i);
  return aside;
}

Expected<void> sync_folder(const fs::path& folder) {
  const FileDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.is_open() && ::fsync(opened.number()) == 0) return {};
  return Failure{folder.string() + ": the folder cannot be written to disk: " + std::strerror(errno)};
}

}  // namespace

Expected<fs::path> move_aside(const fs::path& file, std::int64_t now_ms) {
  const fs::path aside = free_name(file, now_ms);
  for (const std::string_view suffix : kSuffixes) {
    std::error_code error;
    fs::rename(with(file, suffix), with(aside, suffix), error);
    if (error && error != std::errc::no_such_file_or_directory) {
      return Failure{with(file, suffix).string() +
                     ": the damaged file cannot be put aside: " + error.message() + "."};
    }
  }
  const Expected<void> synced = sync_folder(file.parent_path());
  if (!synced.ok()) return Failure{synced.failure()};
  return aside;
}

Expected<std::vector<fs::path>> list_damaged_files(const fs::path& file) {
  const std::string beginning = file.filename().string() + std::string(kMark);
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(file.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (name.starts_with(beginning) && !is_beside(name)) files.push_back(entry->path());
  }
  if (error) return Failure{file.parent_path().string() + ": the folder cannot be read: " + error.message()};
  std::sort(files.begin(), files.end());
  return files;
}

Expected<std::vector<fs::path>> limit_damaged_files(const fs::path& file, std::size_t max) {
  Expected<std::vector<fs::path>> files = list_damaged_files(file);
  if (!files.ok()) return files;
  files->resize(files->size() > max ? files->size() - max : 0);
  for (const fs::path& oldest : *files) {
    for (const std::string_view suffix : kSuffixes) {
      std::error_code error;
      fs::remove(with(oldest, suffix), error);
      if (error) {
        return Failure{with(oldest, suffix).string() + ": the file cannot be deleted: " + error.message()};
      }
    }
  }
  return files;
}

}  // namespace traygauge
