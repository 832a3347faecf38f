#include "firmware/support/found_paths.hpp"

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "firmware/base/wall_clock.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMsPerSecond = 1000;

const char* kind_of(mode_t mode) {
  if (S_ISREG(mode)) return "file";
  if (S_ISDIR(mode)) return "folder";
  if (S_ISLNK(mode)) return "link";
  if (S_ISSOCK(mode)) return "socket";
  if (S_ISCHR(mode)) return "device";
  return "other";
}

std::string user_name(uid_t user) {
  const passwd* const entry = ::getpwuid(user);
  return entry == nullptr ? std::to_string(user) : entry->pw_name;
}

std::string group_name(gid_t group) {
  const ::group* const entry = ::getgrgid(group);
  return entry == nullptr ? std::to_string(group) : entry->gr_name;
}

std::string describe_path(const fs::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0)
    return path.string() + ": " + std::system_category().message(errno) + "\n";
  std::array<char, 8> mode{};
  std::snprintf(mode.data(), mode.size(), "%04o", static_cast<unsigned>(found.st_mode) & 07777U);
  std::string text = path.string();
  text.append(": ").append(kind_of(found.st_mode)).append(", ").append(std::to_string(found.st_size));
  text.append(" bytes, ").append(user_name(found.st_uid)).append(":").append(group_name(found.st_gid));
  text.append(", mode ").append(mode.data()).append(", changed ");
  return text.append(utc_text(found.st_mtim.tv_sec * kMsPerSecond)).append("\n");
}

// The folder and what is in it.
std::string describe_folder(const fs::path& folder) {
  constexpr std::size_t kMaxEntries = 200;
  std::vector<fs::path> entries;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem); entry != fs::directory_iterator();
       entry.increment(problem))
    entries.push_back(entry->path());
  std::sort(entries.begin(), entries.end());
  std::string text = describe_path(folder);
  for (std::size_t i = 0; i < std::min(entries.size(), kMaxEntries); ++i)
    text += "  " + describe_path(entries[i]);
  if (entries.size() > kMaxEntries)
    text += "  and " + std::to_string(entries.size() - kMaxEntries) + " more\n";
  return text;
}

bool names_a_path(const StationValues& station, const StationValue& value) {
  // A line of a chip, "gpiochip0/17", is told with the devices.
  const bool is_line = value.text.starts_with("gpiochip");
  if (!value.is_text || is_line || value.text.find("://") != std::string::npos) return false;
  struct stat ignored {};
  return value.text.find('/') != std::string::npos || ::lstat(station.path_of(value).c_str(), &ignored) == 0;
}

// The folders of the results, if the file says where they are.
std::vector<fs::path> result_folders(const StationValues& station) {
  std::vector<fs::path> folders;
  if (const std::string waiting = station.text_of("station.folder"); !waiting.empty())
    folders.push_back(station.folder() / waiting);
  if (const std::string store = station.text_of("hub.store"); !store.empty())
    folders.push_back((station.folder() / store).parent_path());
  return folders;
}

}  // namespace

std::vector<fs::path> last_good_files(const StationValues& station) {
  constexpr const char* kName = "last-good.toml";
  std::vector<fs::path> files = {fs::path("/var/lib/traygauge/station") / kName,
                                 fs::path("/var/lib/traygauge/hub") / kName};
  for (const fs::path& folder : result_folders(station)) {
    if (std::find(files.begin(), files.end(), folder / kName) == files.end()) files.push_back(folder / kName);
  }
  return files;
}

std::vector<fs::path> station_folders(const StationValues& station) {
  std::vector<fs::path> folders = result_folders(station);
  folders.push_back(station.folder());
  return folders;
}

std::string describe_paths(const StationValues& station) {
  std::string text = "The station file:\n" + describe_path(station.file);
  text += "\nWhat it names:\n";
  for (const StationValue& value : station.values) {
    if (names_a_path(station, value)) text += value.key + ": " + describe_path(station.path_of(value));
  }
  text += "\nThe last good files:\n";
  for (const fs::path& file : last_good_files(station)) text += describe_path(file);
  text += "\nDishes, and the folders of the results:\n" + describe_folder(station.folder() / "dishes");
  for (const fs::path& folder : result_folders(station)) text += describe_folder(folder);
  return text;
}

}  // namespace traygauge
