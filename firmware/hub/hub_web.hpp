// The hub's API and page over HTTP.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "firmware/api/hub_site.hpp"
#include "firmware/base/expected.hpp"
#include "firmware/config/hub_tables.hpp"
#include "firmware/web/access.hpp"
#include "firmware/web/event_streams.hpp"
#include "firmware/web/http_server.hpp"
#include "firmware/web/router.hpp"
#include "firmware/web/site.hpp"
#include "firmware/web/static_files.hpp"

namespace traygauge {

struct HubWebParams {
  WebConfig config;                           // without addresses nothing is served
  std::optional<std::filesystem::path> page;  // the folder of the page's files; none: only the API is served
  std::string configuration_problem;          // for people; empty: there is none
  std::filesystem::path station_file;         // that the hub was started with; empty: with none
};

// What is served. All of it outlives the server.
struct HubParts {
  HubStore& store;
  StationInbox& inbox;
  DriftWatch& drift;
  const ShapeShelf& shapes;
  const PictureShelf& pictures;
};

// Served by the hub's loop: descriptor(), timeout(), run().
class HubWeb {
 public:
  // Fails, with the key, where an address or a token file is of no use, and where others than this machine
  // would be served without a token; and where a file of the page cannot be read.
  static Expected<std::unique_ptr<HubWeb>> start(const HubWebParams& params, const HubParts& hub);
  // Whether start() would take this configuration; opens nothing.
  static Expected<void> check(const WebConfig& config);
  HubWeb(const HubWeb&) = delete;
  HubWeb& operator=(const HubWeb&) = delete;

  int descriptor() const { return server_->descriptor(); }
  std::optional<std::chrono::milliseconds> timeout() const { return server_->timeout(); }
  void run() { server_->run(); }

  // Health and figures tell of these, too; they outlive this.
  void show_webhook(const Webhook& webhook) { hub_site_.webhook = &webhook; }
  void show_fleet(const Fleet& fleet) { hub_site_.fleet = &fleet; }

  void tell_scan(const ScanId& id);
  void tell_shape(const ScanId& id);
  void tell_station(const std::string& station);
  // "http://127.0.0.1:8080"; with the ports that were taken.
  std::string addresses() const;
  // What is answered, and to whom.
  const Router& router() const { return router_; }

 private:
  struct Parts;
  static Expected<Parts> parts_of(const WebConfig& config);
  HubWeb(Parts parts, const HubParts& hub);

  Access access_;
  Router router_;
  StaticFiles files_;
  EventStreams events_;
  HubSite hub_site_;
  std::optional<Site> site_;
  std::optional<HttpServer> server_;
};

}  // namespace traygauge
