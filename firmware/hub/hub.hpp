// The hub: stores what stations measure, on one thread.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "firmware/api/health.hpp"
#include "firmware/base/expected.hpp"
#include "firmware/drift/drift_watch.hpp"
#include "firmware/fleet/fleet.hpp"
#include "firmware/hub/hub_store.hpp"
#include "firmware/hub/hub_web.hpp"
#include "firmware/hub/picture_shelf.hpp"
#include "firmware/hub/shape_shelf.hpp"
#include "firmware/hub/station_inbox.hpp"
#include "firmware/webhook/webhook.hpp"

namespace traygauge {

struct HubParams {
  std::filesystem::path socket;
  HubStoreParams store;
  StationInboxParams inbox;
  HubWebParams web;
  PictureShelfParams pictures;
  std::optional<WebhookConfig> webhook;  // none: nobody is told
  WebhookLimits webhook_limits;
  std::optional<FleetConfig> fleet;  // none: no broker is told
  FleetLimits fleet_limits;
};

// One sentence for each thing that happened.
using HubLog = std::function<void(const std::string&)>;

class Hub {
 public:
  // Fails where the socket, the store's file or an address of the API cannot be had.
  static Expected<std::unique_ptr<Hub>> start(HubParams params, HubLog log);
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  // Until somebody, a signal handler say, sets `stop`. Calls `after_step` whenever what came was done.
  void run(const std::atomic<bool>& stop, const std::function<void()>& after_step = {});
  // Waits for at most so long for something to do, and does it.
  void step(std::chrono::milliseconds longest_wait);

  HubStore& store() { return store_; }
  StationInbox& inbox() { return inbox_; }
  // Null where nothing is served.
  HubWeb* web() { return web_.get(); }

 private:
  Hub(HubStore store, LocalListener listener, const HubParams& params, HubLog log);
  StationListener listener_for_inbox();
  void tidy_pictures();
  Expected<void> start_webhook(const std::optional<WebhookConfig>& config, const WebhookLimits& limits);
  Expected<void> start_fleet(const std::optional<FleetConfig>& config, const FleetLimits& limits);
  Expected<void> abandon(const char* destination, const char* key);
  HealthSubjects health_subjects() const;
  std::string drift_of(const std::string& name) const;
  void follow_drift();
  void log_problem(const std::string& problem);

  HubLog log_;
  std::string last_problem_;
  std::string configuration_problem_;
  HubStore store_;
  DriftWatch drift_{store_};
  ShapeShelf shapes_;
  PictureShelf pictures_;
  std::chrono::steady_clock::time_point tidied_at_;  // the pictures
  StationInbox inbox_;
  std::unique_ptr<Webhook> webhook_;
  std::unique_ptr<Fleet> fleet_;
  std::unique_ptr<HubWeb> web_;
};

}  // namespace traygauge
