// What the hub's API answers from. All of it outlives the routes.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "firmware/base/wall_clock.hpp"
#include "firmware/drift/drift_watch.hpp"
#include "firmware/fleet/fleet.hpp"
#include "firmware/hub/hub_store.hpp"
#include "firmware/hub/picture_shelf.hpp"
#include "firmware/hub/shape_shelf.hpp"
#include "firmware/hub/station_inbox.hpp"
#include "firmware/web/event_streams.hpp"
#include "firmware/web/http_server.hpp"
#include "firmware/web/router.hpp"
#include "firmware/webhook/webhook.hpp"

namespace traygauge {

// What is told of the hub itself.
struct SiteFacts {
  std::string name;       // for people; empty: none
  std::string time_zone;  // such as "Europe/Berlin"; empty: it has no name
  std::string program_version;
  std::string commit;                  // that it was built from; empty: not known
  std::string configuration_problem;   // empty: the configuration is the one that somebody wrote
  std::filesystem::path station_file;  // that the hub was started with; empty: with none
};

struct HubSite {
  HubStore& store;
  StationInbox& inbox;
  DriftWatch& drift;
  const ShapeShelf& shapes;
  const PictureShelf& pictures;
  EventStreams& events;
  SiteFacts facts;
  std::function<HttpCounts()> http;
  std::function<WallTime()> wall_clock = read_wall_clock;
  std::chrono::steady_clock::time_point started_at = std::chrono::steady_clock::now();
  const Webhook* webhook = nullptr;  // null: nobody is told
  const Fleet* fleet = nullptr;      // null: no broker is told
};

// Everything below /api/v1, /health and /metrics; firmware/README.md lists it.
void add_scan_routes(Router& router, const HubSite& site);
void add_next_tray_routes(Router& router, const HubSite& site);
void add_shape_routes(Router& router, const HubSite& site);
void add_correction_routes(Router& router, const HubSite& site);
void add_export_routes(Router& router, const HubSite& site);
void add_site_routes(Router& router, const HubSite& site);
void add_station_routes(Router& router, const HubSite& site);
void add_health_routes(Router& router, const HubSite& site);
void add_metrics_route(Router& router, const HubSite& site);
void add_description_route(Router& router);

}  // namespace traygauge
