#include "firmware/support/support_command.hpp"

#include <ostream>
#include <string>
#include <vector>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/command/program.hpp"
#include "firmware/support/archive.hpp"
#include "firmware/support/bounded_program.hpp"
#include "firmware/support/connected_devices.hpp"
#include "firmware/support/durable_files.hpp"
#include "firmware/support/found_paths.hpp"
#include "firmware/support/hub_health.hpp"
#include "firmware/support/machine_facts.hpp"
#include "firmware/support/secret_filter.hpp"
#include "firmware/support/station_values.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStationUnit = "traygauge-station.service";
constexpr const char* kHubUnit = "traygauge-hub.service";

// Tells the filter the secrets of the file and of the last good ones, which may name others.
std::vector<fs::path> learn_secrets(const StationValues& station, SecretFilter& filter) {
  std::vector<fs::path> unread = add_station_secrets(station, filter);
  for (const fs::path& file : last_good_files(station)) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) continue;
    StationValues last_good = read_station_values(file);
    last_good.file = station.file;  // to whose folder its paths are relative
    const std::vector<fs::path> more = add_station_secrets(last_good, filter);
    unread.insert(unread.end(), more.begin(), more.end());
  }
  return unread;
}

std::string log_of(const std::string& unit) {
  const std::string log =
      output_of({"journalctl", "--no-pager", "--quiet", "-n", "2000", "-o", "short-iso", "-u", unit});
  return log.empty() ? "(the log of " + unit + " is empty)\n" : log;
}

std::string services() {
  return output_of({"systemctl", "--no-pager", "--full", "--lines=0", "status", kStationUnit, kHubUnit});
}

std::string check_config(const fs::path& station) {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  return output_of({program.string(), "config", "check", station.string()});
}

std::vector<std::string> listen_addresses(const StationValues& station) {
  std::vector<std::string> addresses;
  for (const StationValue& value : station.values) {
    if (value.key.starts_with("hub.listen")) addresses.push_back(value.text);
  }
  return addresses;
}

std::string explain_omission(const std::vector<fs::path>& unread) {
  std::string text =
      "This is left out: secrets could not be looked for, because these files of secrets cannot be read (try "
      "again as root):\n";
  for (const fs::path& file : unread) text.append(file.string()).append("\n");
  return text;
}

std::vector<ArchivedFile> collect(const StationValues& station, const std::vector<fs::path>& unread) {
  // Secrets that cannot be read cannot be looked for: then nothing that others wrote leaves this machine.
  const auto unless_unread = [&unread](const auto& text) {
    return unread.empty() ? text() : explain_omission(unread);
  };
  return {{"versions.txt", describe_versions()},
          {"station_file.txt", show_station_values(station)},
          {"config_check.txt", check_config(station.file)},
          {"paths.txt", describe_paths(station)},
          {"devices.txt", describe_devices()},
          {"machine.txt", describe_state(station_folders(station))},
          {"services.txt", unless_unread(services)},
          {"log_station.txt", unless_unread([] { return log_of(kStationUnit); })},
          {"log_hub.txt", unless_unread([] { return log_of(kHubUnit); })},
          {"hub_health.txt", unless_unread([&] { return ask_hub_health(listen_addresses(station)); })}};
}

}  // namespace

void add_support_command(Program& program, SupportOptions& options) {
  Command command = program.add_command(
      "support", "Write a file for a developer, without secrets and pictures: state, versions, log");
  command.add_option("STATION", options.station, "The station file, which may be bad or absent").required();
  command.add_option("--out", options.out, "The file to write, such as kitchen.tar.gz").required();
}

int run_support(const SupportOptions& options, std::ostream& out) {
  constexpr std::int64_t kMsPerS = 1000;
  constexpr std::size_t kBytesPerKb = 1000;
  const Expected<void> place = check_archive_place(options.out);
  if (!place.ok()) throw UsageError(place.failure());
  const StationValues station = read_station_values(options.station);
  SecretFilter filter;
  const std::vector<fs::path> unread = learn_secrets(station, filter);
  std::vector<ArchivedFile> files = collect(station, unread);
  for (ArchivedFile& file : files) {
    file.content = filter.clean(file.content);
    file.name.insert(0, "traygauge-support/");
  }
  const Expected<std::string> packed = pack_files(files, read_wall_clock().unix_ms / kMsPerS);
  if (!packed.ok()) throw UsageError(options.out.string() + ": cannot be written: " + packed.failure());
  const Expected<void> written = write_files({{options.out, *packed, 0644}}, IfThere::replace);
  if (!written.ok()) throw UsageError(written.failure());
  out << options.out.string() << ": wrote " << files.size() << " texts, "
      << (packed->size() + kBytesPerKb - 1) / kBytesPerKb
      << " kB, without pictures and without the secrets that the station file names; ";
  if (!unread.empty())
    out << "logs are left out, because this user may not read files of secrets (try as root); ";
  out << "before you send it, unpack it and read log_station.txt, log_hub.txt and station_file.txt for what "
         "nobody "
         "else may see."
      << std::endl;
  return kExitMeasured;
}

}  // namespace traygauge
