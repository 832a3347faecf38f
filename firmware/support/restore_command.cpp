#include "firmware/support/restore_command.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/check/config_check.hpp"
#include "firmware/command/program.hpp"
#include "firmware/support/archive.hpp"
#include "firmware/support/backup_manifest.hpp"
#include "firmware/support/durable_files.hpp"
#include "firmware/support/station_name.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw UsageError(printable(file.string()) + ": nothing was restored: " + reason);
}

// Whether something stands there. A link on the way would lead out of the folder.
bool is_taken(const fs::path& folder, const std::string& name) {
  fs::path place = folder;
  struct stat found {};
  for (const fs::path& part : fs::path(name)) {
    const bool is_below = place != folder;
    if (is_below && ::lstat(place.c_str(), &found) == 0 && !S_ISDIR(found.st_mode))
      refuse(place, "it is no folder, or a link");
    place /= part;
  }
  if (::lstat(place.c_str(), &found) != 0) return false;
  if (S_ISDIR(found.st_mode)) refuse(place, "it is a folder, and a file in the backup");
  return true;
}

void check_places(const RestoreOptions& options, const std::vector<ArchivedFile>& files) {
  std::error_code ignored;
  if (fs::exists(options.folder, ignored) && !fs::is_directory(options.folder, ignored))
    refuse(options.folder, "it is no folder");
  std::vector<std::string> taken;
  for (const ArchivedFile& file : files) {
    if (is_taken(options.folder, file.name)) taken.push_back(file.name);
  }
  if (taken.empty() || options.force) return;
  const std::string others = taken.size() == 1 ? "" : " and " + std::to_string(taken.size() - 1) + " more";
  refuse(options.folder, "there is a file " + taken.front() + others + " already; --force replaces them");
}

std::vector<ArchivedFile> read_backup(const RestoreOptions& options, BackupManifest& manifest) {
  const Expected<std::string> bytes = read_file(options.backup, kMaxArchiveBytes);
  if (!bytes.ok()) throw UsageError(bytes.failure());
  Expected<std::vector<ArchivedFile>> files = unpack_files(*bytes);
  if (!files.ok()) refuse(options.backup, files.failure());
  const Expected<BackupManifest> checked = take_manifest(*files);
  if (!checked.ok()) refuse(options.backup, checked.failure());
  manifest = *checked;
  return std::move(*files);
}

void rename_station(const RestoreOptions& options, std::string& content) {
  if (!is_station_name(options.name)) {
    throw UsageError("--name " + options.name +
                     ": expected 1 to 32 of a-z, 0-9 and '-', with no '-' at either end");
  }
  const Expected<std::string> renamed = with_station_name(content, options.name);
  if (!renamed.ok()) refuse(options.backup, renamed.failure());
  content = *renamed;
}

}  // namespace

void add_restore_command(Program& program, RestoreOptions& options) {
  Command command = program.add_command("restore", "Write the files of a backup, and check them");
  command.add_option("FILE", options.backup, "What traygauge backup wrote").required();
  command.add_option("--to", options.folder, "The folder that gets the files; made where it is missing")
      .required();
  command.add_option("--name", options.name, "What the station is called from now on, such as kitchen-2");
  command.add_flag("--force", options.force, "Replace files that are there");
}

int run_restore(const RestoreOptions& options, std::ostream& out) {
  BackupManifest manifest;
  std::vector<ArchivedFile> files = read_backup(options, manifest);
  // The station file comes last: as long as it is missing, nobody takes a part for the whole.
  std::stable_partition(files.begin(), files.end(),
                        [&](const ArchivedFile& file) { return file.name != manifest.station; });
  if (!options.name.empty()) rename_station(options, files.back().content);
  check_places(options, files);
  std::vector<FileToWrite> writing;
  writing.reserve(files.size());
  for (ArchivedFile& file : files)
    writing.push_back({options.folder / file.name, std::move(file.content), file.mode & 0755U});
  const Expected<void> written = write_files(writing, options.force ? IfThere::replace : IfThere::refuse);
  if (!written.ok()) throw UsageError(written.failure());
  out << options.folder.string() << ": restored " << files.size() << " files of "
      << printable(manifest.made_at);
  const auto is_outside = [](const ArchivedFile& file) { return file.name.starts_with("outside/"); };
  if (std::any_of(files.begin(), files.end(), is_outside))
    out << "; those in outside/ have to be put where the station file names them";
  for (std::size_t i = 0; i < manifest.left_out.size(); ++i)
    out << (i == 0 ? "; not in the backup, and to be made anew: " : " ") << printable(manifest.left_out[i]);
  out << "." << std::endl;
  return run_config_check({(options.folder / manifest.station).string()}, out);
}

}  // namespace traygauge
