#include "firmware/hub/hub_web.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "firmware/base/build_info.hpp"
#include "firmware/base/time_zone.hpp"
#include "firmware/hub/page_files.hpp"
#include "firmware/web/login.hpp"

namespace traygauge {
namespace {

template <class Value>
Failure of_key(const char* key, const Expected<Value>& failed) {
  return {std::string("hub.") + key + ": " + failed.failure()};
}

Expected<AccessParams> access_params(const WebConfig& config) {
  AccessParams params;
  if (config.view_tokens) params.token_files.push_back({*config.view_tokens, Role::view});
  if (config.kiosk_tokens) params.token_files.push_back({*config.kiosk_tokens, Role::kiosk});
  if (config.manage_tokens) params.token_files.push_back({*config.manage_tokens, Role::manage});
  if (config.local_without_token) params.local = LocalRule::open;
  for (const std::string& proxy : config.trusted_proxies) {
    const auto range = AddressRange::parse(proxy);
    if (!range)
      return Failure{"hub.trusted_proxies: expected an address or a range such as 192.0.2.0/24, found " +
                     proxy};
    params.trusted_proxies.push_back(*range);
  }
  return params;
}

Expected<std::vector<ListenAddress>> listen_addresses(const WebConfig& config) {
  std::vector<ListenAddress> addresses;
  for (const std::string& text : config.listen) {
    const Expected<ListenAddress> address = parse_listen_address(text);
    if (!address.ok()) return of_key("listen", address);
    addresses.push_back(*address);
  }
  return addresses;
}

}  // namespace

struct HubWeb::Parts {
  AccessParams access;
  SiteParams site;
  std::vector<ListenAddress> addresses;
  SiteFacts facts;
};

// What of a configuration can be judged before anything is opened.
Expected<HubWeb::Parts> HubWeb::parts_of(const WebConfig& config) {
  Expected<AccessParams> access = access_params(config);
  if (!access.ok()) return Failure{access.failure()};
  Expected<std::vector<ListenAddress>> addresses = listen_addresses(config);
  if (!addresses.ok()) return Failure{addresses.failure()};
  Expected<std::vector<std::string>> base = parse_base_path(config.base_path);
  if (!base.ok()) return of_key("base_path", base);
  if (!config.time_zone.empty()) {
    if (const auto set = set_time_zone(config.time_zone); !set.ok()) return of_key("time_zone", set);
  }
  SiteFacts facts;
  facts.name = config.site_name;
  facts.time_zone = config.time_zone.empty() ? machine_time_zone() : config.time_zone;
  facts.program_version = program_version();
  facts.commit = built_commit();
  return Parts{
      std::move(*access), {config.host_names, std::move(*base)}, std::move(*addresses), std::move(facts)};
}

Expected<void> HubWeb::check(const WebConfig& config) {
  Expected<Parts> parts = parts_of(config);
  if (!parts.ok()) return Failure{parts.failure()};
  const Expected<void> may = Access(std::move(parts->access)).check_listen(parts->addresses);
  return may.ok() ? Expected<void>() : of_key("listen", may);
}

Expected<std::unique_ptr<HubWeb>> HubWeb::start(const HubWebParams& params, const HubParts& hub) {
  Expected<Parts> parts = parts_of(params.config);
  if (!parts.ok()) return Failure{parts.failure()};
  parts->facts.configuration_problem = params.configuration_problem;
  parts->facts.station_file = params.station_file;
  const std::vector<ListenAddress> addresses = parts->addresses;
  std::unique_ptr<HubWeb> web(new HubWeb(std::move(*parts), hub));
  if (const Expected<void> may = web->access_.check_listen(addresses); !may.ok())
    return of_key("listen", may);
  if (params.page) {
    const Expected<void> read = read_page(*params.page, web->files_);
    if (!read.ok()) return Failure{read.failure()};
  }
  std::vector<Listener> listeners;
  for (const ListenAddress& address : addresses) {
    Expected<Listener> listener = Listener::open(address);
    if (!listener.ok()) return of_key("listen", listener);
    listeners.push_back(std::move(*listener));
  }
  Expected<HttpServer> server = HttpServer::start({}, std::move(listeners), *web->site_);
  if (!server.ok()) return of_key("listen", server);
  web->server_.emplace(std::move(*server));
  return web;
}

HubWeb::HubWeb(Parts parts, const HubParts& hub)
    : access_(std::move(parts.access)),
      events_(EventStreamLimits{}),
      hub_site_{
          hub.store, hub.inbox, hub.drift, hub.shapes, hub.pictures, events_, std::move(parts.facts), [this] {
            return server_->counts();
          }} {
  add_login_routes(router_, access_);
  add_scan_routes(router_, hub_site_);
  add_next_tray_routes(router_, hub_site_);
  add_shape_routes(router_, hub_site_);
  add_correction_routes(router_, hub_site_);
  add_export_routes(router_, hub_site_);
  add_site_routes(router_, hub_site_);
  add_station_routes(router_, hub_site_);
  add_health_routes(router_, hub_site_);
  add_metrics_route(router_, hub_site_);
  add_description_route(router_);
  site_.emplace(std::move(parts.site), access_, router_, files_, events_);
}

void HubWeb::tell_scan(const ScanId& id) {
  events_.broadcast({"scan", nlohmann::json{{"id", scan_id_text(id)}}.dump(), {}});
}

void HubWeb::tell_shape(const ScanId& id) {
  events_.broadcast({"shape", nlohmann::json{{"id", scan_id_text(id)}}.dump(), {}});
}

void HubWeb::tell_station(const std::string& station) {
  events_.broadcast({"station", nlohmann::json{{"name", station}}.dump(), {}});
}

std::string HubWeb::addresses() const {
  std::string text;
  for (const Listener& listener : server_->listeners()) {
    const ListenAddress& address = listener.address();
    if (!text.empty()) text += ", ";
    if (address.path.empty()) text += "http://";
    text += address.text();
  }
  return text;
}

}  // namespace traygauge
