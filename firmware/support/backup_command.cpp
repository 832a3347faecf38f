#include "firmware/support/backup_command.hpp"

#include <algorithm>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "firmware/base/build_info.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/command/program.hpp"
#include "firmware/support/archive.hpp"
#include "firmware/support/backup_manifest.hpp"
#include "firmware/support/durable_files.hpp"
#include "firmware/support/station_values.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

// Below the station file's folder a file keeps its place; others go into a folder of their own.
std::string archive_name(const fs::path& folder, const fs::path& file) {
  const fs::path place = fs::absolute(file).lexically_normal();
  const fs::path relative = place.lexically_relative(fs::absolute(folder).lexically_normal());
  const bool is_below = !relative.empty() && *relative.begin() != "..";
  return is_below ? relative.string() : "outside" + place.string();
}

class Backup {
 public:
  Backup(const StationValues& station, bool with_secrets) : station_(station), with_secrets_(with_secrets) {
    manifest_.program = program_version();
    manifest_.made_at = utc_text(read_wall_clock().unix_ms);
    manifest_.station = station.file.filename().string();
    take(station.file, false);
    for (const StationValue& value : station.values) take_named(value);
    take_dishes();
  }

  Expected<std::string> pack() const {
    constexpr std::int64_t kMsPerS = 1000;
    std::vector<ArchivedFile> all = files_;
    all.insert(all.begin(), compose_manifest(manifest_, files_));
    return pack_files(all, read_wall_clock().unix_ms / kMsPerS);
  }
  const std::vector<ArchivedFile>& files() const { return files_; }
  const BackupManifest& manifest() const { return manifest_; }

 private:
  void take_named(const StationValue& value) {
    std::error_code ignored;
    const fs::path file = station_.path_of(value);
    // The store is a file, too: results have backups of their own.
    if (!value.is_text || value.key == "hub.store" || !fs::is_regular_file(file, ignored)) return;
    take(file, is_secret_key(value.key));
  }

  void take_dishes() {
    std::vector<fs::path> dishes;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(station_.folder() / "dishes", ignored)) {
      if (entry.path().extension() == ".toml" && entry.is_regular_file(ignored))
        dishes.push_back(entry.path());
    }
    std::sort(dishes.begin(), dishes.end());
    for (const fs::path& dish : dishes) take(dish, false);
  }

  void take(const fs::path& file, bool is_secret) {
    const std::string name = archive_name(station_.folder(), file);
    if (!is_archive_name(name)) throw UsageError(printable(file.string()) + ": its name cannot be archived");
    if (!names_.insert(name).second) return;
    if (is_secret && !with_secrets_) {
      manifest_.left_out.push_back(name);
      return;
    }
    const Expected<std::string> content = read_file(file, kMaxArchiveBytes - bytes_);
    if (!content.ok()) throw UsageError(content.failure());
    // The manifest is a file of the archive, too.
    if (files_.size() + 1 >= kMaxArchiveFiles) throw UsageError("more than 1,000 files cannot be archived");
    bytes_ += content->size();
    constexpr unsigned kNotForOthersToWrite = 0755;
    const auto mode = static_cast<unsigned>(fs::status(file).permissions());
    files_.push_back({name, *content, is_secret ? 0600 : mode & kNotForOthersToWrite});
  }

  const StationValues& station_;
  bool with_secrets_;
  BackupManifest manifest_;
  std::vector<ArchivedFile> files_;
  std::set<std::string> names_;
  std::size_t bytes_ = 0;
};

}  // namespace

void add_backup_command(Program& program, BackupOptions& options) {
  Command command = program.add_command("backup", "Write a station's configuration to one file");
  command.add_option("STATION", options.station, "The station file; see config/station.toml").required();
  command.add_option("--out", options.out, "The file to write, such as kitchen.tar.gz").required();
  command.add_flag("--with-secrets", options.with_secrets, "Take the files of tokens and secrets, too");
}

int run_backup(const BackupOptions& options, std::ostream& out) {
  const Expected<void> place = check_archive_place(options.out);
  if (!place.ok()) throw UsageError(place.failure());
  const StationValues station = read_station_values(options.station);
  if (!station.problem.empty()) throw UsageError(station.problem);
  const Backup backup(station, options.with_secrets);
  const Expected<std::string> packed = backup.pack();
  if (!packed.ok()) throw UsageError(options.out.string() + ": cannot be written: " + packed.failure());
  // The station file alone may hold a password, in the webhook's address.
  const Expected<void> written = write_files({{options.out, *packed, 0600}}, IfThere::replace);
  if (!written.ok()) throw UsageError(written.failure());
  out << options.out.string() << ": wrote " << backup.files().size() << " files";
  const std::vector<std::string>& left_out = backup.manifest().left_out;
  for (std::size_t i = 0; i < left_out.size(); ++i)
    out << (i == 0 ? "; left out without --with-secrets: " : " ") << printable(left_out[i]);
  out << "." << std::endl;
  return kExitMeasured;
}

}  // namespace traygauge
