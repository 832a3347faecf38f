#include "firmware/hub/hub_command.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <utility>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/command/service_manager.hpp"
#include "firmware/config/hub_tables.hpp"
#include "firmware/hub/hub.hpp"
#include "firmware/hub/page_files.hpp"
#include "firmware/store/schema.hpp"

namespace traygauge {
namespace {

// What is said on the command line counts; the rest is the file's.
ChosenConfig<HubFile> choose(const HubCommand& command) {
  ChosenConfig<HubFile> read;
  HubFile& chosen = read.config;
  if (!command.config.empty()) {
    const auto read_checked = [&command](const std::filesystem::path& content) {
      HubFile file = read_hub_file(command.config, content);
      const Expected<void> checked = HubWeb::check(file.hub.web);
      if (!checked.ok()) throw UsageError(content.string() + ": " + checked.failure());
      if (file.hub.webhook) {
        const Expected<void> webhook = Webhook::check(*file.hub.webhook);
        if (!webhook.ok()) throw UsageError(content.string() + ": " + webhook.failure());
      }
      if (file.fleet) {
        const Expected<void> fleet = Fleet::check(*file.fleet);
        if (!fleet.ok()) throw UsageError(content.string() + ": " + fleet.failure());
      }
      return file;
    };
    read = read_or_last_good(command.config, command.last_good, read_checked,
                             [](const HubFile& file) { return file.on_bad_config; });
  }
  if (!command.socket.empty()) chosen.socket = command.socket;
  if (!command.store.empty()) chosen.hub.store = command.store;
  if (!command.listen.empty()) chosen.hub.web.listen = command.listen;
  if (chosen.socket.empty() || chosen.hub.store.empty())
    throw UsageError("expected --config FILE, or --socket PATH and --store FILE");
  return read;
}

HubParams params_of(const HubFile& file) {
  constexpr auto kBytesPerMib = std::int64_t{1024} * 1024;
  HubParams params;
  params.socket = file.socket;
  params.web.config = file.hub.web;
  params.webhook = file.hub.webhook;
  params.fleet = file.fleet;
  params.store.options.file = file.hub.store;
  params.pictures.folder = file.hub.store.parent_path() / "pictures";
  params.pictures.max_bytes_on_disk = static_cast<std::uint64_t>(file.hub.pictures_mib * kBytesPerMib);
  if (file.hub.keep_days) params.store.retention.max_age = std::chrono::days(*file.hub.keep_days);
  params.store.retention.min_free_bytes = file.hub.keep_free_mib * kBytesPerMib;
  return params;
}

// Who may not look at the store is not told of it: the file of a station is checked by others, too.
std::string describe_store(const std::filesystem::path& file) {
  if (::access(file.c_str(), R_OK) != 0)
    return errno == ENOENT ? ", which does not exist yet" : ", which this user may not look at";
  const Expected<std::int64_t> version = peek_store_version(file);
  if (!version.ok()) throw UsageError(version.failure());
  return *version == 0 ? ", which is empty yet" : ", a store of version " + std::to_string(*version);
}

}  // namespace

void add_hub_options(Program& program, HubCommand& command) {
  Command hub = program.add_command("hub", "Store what stations measure");
  hub.add_option("--config", command.config, "A station file with [station] and [hub] (config/station.toml)");
  hub.add_option("--socket", command.socket, "Where stations find the hub: a path for a Unix socket");
  hub.add_option("--store", command.store, "The file that results are stored in; made where there is none");
  hub.add_option("--listen", command.listen,
                 "Where the API is served, such as 127.0.0.1:8080; may be given several times");
  hub.add_option("--last-good", command.last_good,
                 "Where a copy of the station file is kept, which counts where a later one is bad "
                 "(on_bad_config in the file)");
  hub.add_flag("--check", command.only_check, "Only say whether configuration and store are as expected");
}

int run_hub(const HubCommand& command, const std::atomic<bool>& stop, std::ostream& out, std::ostream& log) {
  const ChosenConfig<HubFile> chosen = choose(command);
  const HubFile& file = chosen.config;
  if (!chosen.problem.empty()) log << chosen.problem << std::endl;
  if (command.only_check) {
    const std::string store = file.hub.store.string() + describe_store(file.hub.store);
    out << command.config << ": as expected for a hub; results go to " << store << "." << std::endl;
    return kExitMeasured;
  }
  const auto write = [&log](const std::string& sentence) { log << sentence << std::endl; };
  HubParams params = params_of(file);
  params.web.configuration_problem = chosen.problem;
  params.web.station_file = command.config;
  params.web.page = find_page_folder();
  const bool has_page = params.web.page.has_value();
  const Expected<std::unique_ptr<Hub>> hub = Hub::start(std::move(params), write);
  if (!hub.ok()) throw UsageError(hub.failure());
  out << "The hub stores results in " << file.hub.store.string() << " and listens at " << file.socket.string()
      << "." << std::endl;
  if ((*hub)->web() != nullptr)
    out << (has_page ? "The page is at " : "No page is installed; the API is at ")
        << (*hub)->web()->addresses() << "." << std::endl;
  ServiceManager manager;
  (*hub)->run(stop, [&manager] { manager.note_progress(); });
  manager.note_stopping();
  return kExitMeasured;
}

}  // namespace traygauge
