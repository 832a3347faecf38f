// The tables of a station file that say where results go: [station], [hub] and [fleet].
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config/last_good.hpp"
#include "firmware/fleet/fleet_config.hpp"
#include "simulator/capture/json_node.hpp"

namespace traygauge {

// A station file is larger only by mistake.
inline constexpr std::size_t kMaxStationFileBytes = std::size_t{1} << 16U;

// What becomes of the trays' photographs.
enum class PicturePolicy : std::uint8_t {
  hide,  // they never leave the station's memory
  show,  // the hub has the last ones in its memory
  keep,  // the hub keeps them on its disk, as long as their scans
};

// How a station hands its results over.
struct HandoverConfig {
  std::string name = "station";   // see is_station_name()
  std::filesystem::path socket;   // the hub's
  std::filesystem::path folder;   // where results wait, and where the last scan's number stands
  int waiting_mib = 16;           // about 4,000 results
  double repeat_within_s = 20.0;  // 0: every press counts
  PicturePolicy pictures = PicturePolicy::hide;
};

// Where the hub serves its API, and to whom.
struct WebConfig {
  std::vector<std::string> listen;  // addresses, see parse_listen_address(); none: nothing is served
  // Files of tokens, by role; none: only who is on this machine is served.
  std::optional<std::filesystem::path> view_tokens;
  std::optional<std::filesystem::path> kiosk_tokens;
  std::optional<std::filesystem::path> manage_tokens;
  bool local_without_token = false;          // though there are tokens: no proxy may stand beside the hub
  std::vector<std::string> host_names;       // of the hub, beside localhost and literal addresses
  std::vector<std::string> trusted_proxies;  // addresses whose X-Forwarded-For is believed
  std::string base_path;                     // under which a proxy shows the hub
  std::string site_name;                     // for people; empty: none
  std::string time_zone;                     // see set_time_zone(); empty: this machine's
};

// Who is told of each scan.
struct WebhookConfig {
  std::string address;                           // see parse_webhook_address()
  std::optional<std::filesystem::path> secret;   // a file, by whose content messages are signed
  std::optional<std::filesystem::path> trusted;  // a file with certificates; none: the system's
};

struct HubConfig {
  std::filesystem::path store;   // a file
  std::optional<int> keep_days;  // none: as long as there is space
  int keep_free_mib = 500;       // of the file system
  int pictures_mib = 1024;       // of pictures that are kept, at most
  WebConfig web;
  std::optional<WebhookConfig> webhook;
};

// Both read a table whose unknown keys are errors. Relative paths are relative to `folder`, the file's.
HandoverConfig read_handover_table(const JsonNode& table, const std::filesystem::path& folder);
HubConfig read_hub_table(const JsonNode& table, const std::filesystem::path& folder);

// The key of a file that says what becomes of the program when the next one is bad.
OnBadConfig read_on_bad_config(const JsonNode& root);

// A station file may say `version = 1`; one that does not is of version 1. Throws InputError for every other:
// a later version would be understood by halves.
void check_station_version(const JsonNode& root);

// What a hub needs of a station file.
struct HubFile {
  OnBadConfig on_bad_config = OnBadConfig::keep;
  std::filesystem::path socket;
  HubConfig hub;
  std::optional<FleetConfig> fleet;
};

// Paths are relative to `file`; `content` is read, which is another file where that is the last good one.
// Throws InputError where it cannot be read, and where [hub] or the key station.socket is absent.
HubFile read_hub_file(const std::filesystem::path& file, const std::filesystem::path& content);

}  // namespace traygauge
