#include "firmware/config/hub_tables.hpp"

#include <string_view>

#include "firmware/base/scan_id.hpp"
#include "firmware/webhook/webhook_address.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {
namespace {

constexpr int kStationFileVersion = 1;
constexpr int kMaxMib = 1024;
constexpr int kMaxFreeMib = 1024 * 1024;
constexpr int kMaxDays = 36'500;

template <std::size_t N>
void expect(const JsonNode& table, const std::string_view (&keys)[N]) {
  expect_keys(table, keys);
}

std::vector<std::string> read_texts(const JsonNode& node) {
  constexpr std::size_t kMaxEntries = 32;
  std::vector<std::string> texts;
  for (const JsonNode& entry : node.elements(0, kMaxEntries)) texts.push_back(entry.text());
  return texts;
}

WebConfig read_web(const JsonNode& table, const std::filesystem::path& folder) {
  WebConfig web;
  if (const auto listen = table.find("listen")) web.listen = read_texts(*listen);
  const auto take_file = [&](const char* key, std::optional<std::filesystem::path>& file) {
    if (const auto node = table.find(key)) file = folder / node->text();
  };
  take_file("view_tokens", web.view_tokens);
  take_file("kiosk_tokens", web.kiosk_tokens);
  take_file("manage_tokens", web.manage_tokens);
  if (const auto local = table.find("local_without_token")) web.local_without_token = local->truth();
  if (const auto names = table.find("host_names")) web.host_names = read_texts(*names);
  if (const auto proxies = table.find("trusted_proxies")) web.trusted_proxies = read_texts(*proxies);
  if (const auto base = table.find("base_path")) web.base_path = base->text();
  if (const auto name = table.find("site_name")) web.site_name = name->text();
  if (const auto zone = table.find("time_zone")) web.time_zone = zone->text();
  return web;
}

std::optional<WebhookConfig> read_webhook(const JsonNode& table, const std::filesystem::path& folder) {
  const auto address = table.find("webhook");
  const auto secret = table.find("webhook_secret");
  const auto trusted = table.find("webhook_ca");
  if (!address) {
    if (secret) secret->fail("the key webhook beside this one", "add it, or remove this one");
    if (trusted) trusted->fail("the key webhook beside this one", "add it, or remove this one");
    return std::nullopt;
  }
  WebhookConfig config;
  config.address = address->text();
  // What was found is described, not repeated: an address may hold secrets.
  if (const auto parsed = parse_webhook_address(config.address); !parsed.ok())
    throw InputError(InputProblem{address->file(), address->key(), kExpectedWebhookAddress, parsed.failure(),
                                  "correct the value"});
  if (secret) config.secret = folder / secret->text();
  if (trusted) config.trusted = folder / trusted->text();
  return config;
}

PicturePolicy read_picture_policy(const JsonNode& node) {
  const std::string text = node.text();
  if (text == "hide") return PicturePolicy::hide;
  if (text == "show") return PicturePolicy::show;
  if (text == "keep") return PicturePolicy::keep;
  node.fail(R"("hide", "show" or "keep")", "correct the value");
}

}  // namespace

HandoverConfig read_handover_table(const JsonNode& table, const std::filesystem::path& folder) {
  expect(table, {"name", "socket", "folder", "waiting_mib", "repeat_within_s", "pictures"});
  HandoverConfig config;
  const JsonNode name = table.member("name");
  config.name = name.text();
  if (!is_station_name(config.name)) {
    name.fail("1 to 32 of a-z, 0-9 and '-', with no '-' at either end",
              "other programs use it in addresses and topics");
  }
  config.socket = folder / table.member("socket").text();
  config.folder = folder / table.member("folder").text();
  if (const auto waiting = table.find("waiting_mib")) config.waiting_mib = waiting->integer(1, kMaxMib);
  if (const auto repeat = table.find("repeat_within_s"))
    config.repeat_within_s = repeat->number({0.0, 600.0});
  if (const auto pictures = table.find("pictures")) config.pictures = read_picture_policy(*pictures);
  return config;
}

HubConfig read_hub_table(const JsonNode& table, const std::filesystem::path& folder) {
  expect(table, {"store", "keep_days", "keep_free_mib", "pictures_mib", "listen", "view_tokens",
                 "kiosk_tokens", "manage_tokens", "local_without_token", "host_names", "trusted_proxies",
                 "base_path", "site_name", "time_zone", "webhook", "webhook_secret", "webhook_ca"});
  HubConfig config;
  config.store = folder / table.member("store").text();
  if (const auto days = table.find("keep_days")) config.keep_days = days->integer(1, kMaxDays);
  if (const auto free = table.find("keep_free_mib")) config.keep_free_mib = free->integer(0, kMaxFreeMib);
  if (const auto pictures = table.find("pictures_mib"))
    config.pictures_mib = pictures->integer(1, kMaxFreeMib);
  config.web = read_web(table, folder);
  config.webhook = read_webhook(table, folder);
  return config;
}

OnBadConfig read_on_bad_config(const JsonNode& root) {
  const auto node = root.find("on_bad_config");
  if (!node) return OnBadConfig::keep;
  const std::string text = node->text();
  if (text == "keep") return OnBadConfig::keep;
  if (text == "stop") return OnBadConfig::stop;
  node->fail(R"("keep" or "stop")", "correct the value");
}

void check_station_version(const JsonNode& root) {
  check_file_version(root, kStationFileVersion, "station file");
}

HubFile read_hub_file(const std::filesystem::path& file, const std::filesystem::path& content) {
  const JsonDocument document = read_toml(content, kMaxStationFileBytes, "a station in TOML");
  const JsonNode root = document.root();
  check_station_version(root);
  const std::filesystem::path folder = file.parent_path();
  const HandoverConfig station = read_handover_table(root.member("station"), folder);
  HubFile hub{read_on_bad_config(root), station.socket, read_hub_table(root.member("hub"), folder), {}};
  if (const auto fleet = root.find("fleet")) hub.fleet = read_fleet_table(*fleet, station.name, folder);
  return hub;
}

}  // namespace traygauge
