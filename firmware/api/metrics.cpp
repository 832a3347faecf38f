// Figures for Prometheus, in its text format.
#include <array>
#include <string>
#include <vector>

#include "firmware/api/health.hpp"
#include "firmware/api/hub_site.hpp"
#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

class Metrics {
 public:
  void declare(const char* name, const char* type, const char* help) {
    text_ += std::string("# HELP ") + name + " " + help + "\n# TYPE " + name + " " + type + "\n";
  }
  void add(const std::string& name, double value, int decimals = 3) {
    text_ += name + " " + fixed(value, decimals) + "\n";
  }
  void add(const std::string& name, std::uint64_t value) {
    text_ += name + " " + std::to_string(value) + "\n";
  }
  template <class Value>
  void one(const char* name, const char* type, const char* help, Value value) {
    declare(name, type, help);
    add(name, value);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void add_store(Store& store, Metrics& metrics) {
  const Expected<StoreTotals> totals = store.scans().totals();
  if (!totals.ok()) return;
  const auto count = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
  metrics.one("traygauge_stored_scans", "gauge", "Scans in the store.", count(totals->counts.scans));
  metrics.one("traygauge_superseded_scans", "gauge", "Of these, superseded by a second try.",
              count(totals->counts.superseded));
  metrics.one("traygauge_corrected_scans", "gauge", "Of these, corrected by a person.",
              count(totals->counts.corrected));
  metrics.one("traygauge_wrong_scans", "gauge", "Of these, marked as wrong.", count(totals->counts.wrong));
  metrics.one("traygauge_set_aside_documents", "gauge", "Documents that could not be booked.",
              count(totals->counts.set_aside));
  metrics.one("traygauge_store_bytes", "gauge", "Size of the store's file.", count(totals->file_bytes));
  metrics.one("traygauge_store_written_bytes_total", "counter",
              "Bytes written to the store since the hub started; memory cards wear out by them.",
              store.disk().bytes_written);
  metrics.one("traygauge_store_new_scans_total", "counter", "Scans stored since the hub started.",
              store.scans().new_scans());
  metrics.one("traygauge_store_syncs_total", "counter",
              "Times the store waited for the disk since the start.", store.disk().syncs);
}

void add_stations(const HubSite& site, Metrics& metrics) {
  metrics.declare("traygauge_station_connected", "gauge", "Whether the station is connected to the hub.");
  for (const auto& [name, live] : site.inbox.stations())
    metrics.add("traygauge_station_connected{station=\"" + name + "\"}",
                live.is_connected ? std::uint64_t{1} : std::uint64_t{0});
  metrics.declare("traygauge_station_silent_seconds", "gauge", "Since the station said something.");
  const auto now = std::chrono::steady_clock::now();
  for (const auto& [name, live] : site.inbox.stations()) {
    const std::chrono::duration<double> silent = now - live.heard_at;
    metrics.add("traygauge_station_silent_seconds{station=\"" + name + "\"}", silent.count());
  }
}

struct TrendFigure {
  const char* name;
  const char* help;
  double (*value)(const CheckTrend& trend);
  int decimals;
};
constexpr auto kTrendFigures = std::to_array<TrendFigure>(
    {{"traygauge_check_median",
      "Median of a check over the last scans of a station that have it, in the unit of its name.",
      [](const CheckTrend& trend) { return trend.last.value; }, 3},
     {"traygauge_check_median_error", "Standard error of that median.",
      [](const CheckTrend& trend) { return trend.last.sigma; }, 3},
     {"traygauge_check_scans", "Scans that the median is taken over.",
      [](const CheckTrend& trend) { return static_cast<double>(trend.last.count); }, 0},
     {"traygauge_check_drifts", "1 while the median is too far off.",
      [](const CheckTrend& trend) { return trend.drifts ? 1.0 : 0.0; }, 0}});

void add_drift(const DriftWatch& drift, Metrics& metrics) {
  const std::vector<StationTrends> stations = drift.trends();
  for (const TrendFigure& figure : kTrendFigures) {
    metrics.declare(figure.name, "gauge", figure.help);
    for (const StationTrends& station : stations) {
      for (const CheckTrend& trend : station.trends) {
        const std::string labels =
            "{station=\"" + station.station + "\",check=\"" + name(trend.check) + "\"}";
        metrics.add(std::string(figure.name) + labels, figure.value(trend), figure.decimals);
      }
    }
  }
}

void add_webhook(const Webhook& webhook, Metrics& metrics) {
  const WebhookState& state = webhook.state();
  metrics.one("traygauge_webhook_delivered_total", "counter",
              "Scans and corrections that the webhook took since the start.", state.delivered);
  metrics.one("traygauge_webhook_failed_attempts_total", "counter",
              "Attempts to tell the webhook that failed since the start.", state.failed_attempts);
  const Expected<std::int64_t> waiting = webhook.count_waiting();
  if (waiting.ok())
    metrics.one("traygauge_webhook_waiting", "gauge", "Scans and corrections that wait to be told.",
                static_cast<std::uint64_t>(*waiting));
}

void add_fleet(const Fleet& fleet, Metrics& metrics) {
  const FleetState& state = fleet.state();
  metrics.one("traygauge_fleet_connected", "gauge", "1 while the broker of the fleet is connected.",
              fleet.is_connected() ? std::uint64_t{1} : std::uint64_t{0});
  metrics.one("traygauge_fleet_published_total", "counter",
              "Scans and corrections published since the start, each time they were.", state.published);
  metrics.one("traygauge_fleet_delivered_total", "counter",
              "Scans and corrections whose delivery was confirmed since the start.", state.delivered);
  metrics.one("traygauge_fleet_failed_attempts_total", "counter",
              "Times that a delivery was not confirmed in time since the start.", state.failed_attempts);
  metrics.one("traygauge_fleet_undeliverable", "gauge",
              "Scans and corrections that are not confirmed though others are.",
              std::uint64_t{state.undeliverable.size()});
  metrics.one("traygauge_fleet_ignored_messages_total", "counter",
              "Messages to this hub that are no receipts, since the start.", state.ignored);
  const Expected<std::int64_t> waiting = fleet.count_waiting();
  if (waiting.ok())
    metrics.one("traygauge_fleet_waiting", "gauge", "Scans and corrections that wait for the fleet.",
                static_cast<std::uint64_t>(*waiting));
}

HttpResponse answer_metrics(const HubSite& site) {
  Metrics metrics;
  const std::chrono::duration<double> up = std::chrono::steady_clock::now() - site.started_at;
  metrics.one("traygauge_hub_up_seconds", "gauge", "Since the hub started.", up.count());
  metrics.one("traygauge_healthy", "gauge", "1 while no part of hub and stations fails.",
              examine_health(site).worst() != HealthState::failing ? std::uint64_t{1} : std::uint64_t{0});
  if (Store* const store = site.store.store()) add_store(*store, metrics);
  if (site.webhook != nullptr) add_webhook(*site.webhook, metrics);
  if (site.fleet != nullptr) add_fleet(*site.fleet, metrics);
  add_stations(site, metrics);
  add_drift(site.drift, metrics);
  const HttpCounts http = site.http();
  metrics.one("traygauge_http_requests_total", "counter", "Requests answered since the start.",
              http.requests);
  metrics.one("traygauge_http_refused_total", "counter", "Requests refused before they were read.",
              http.refused_requests);
  metrics.one("traygauge_http_connections", "gauge", "Connections that are open.", http.open);
  metrics.one("traygauge_event_streams", "gauge", "Pages that listen.", std::uint64_t{site.events.count()});
  HttpResponse response;
  response.content_type = "text/plain; version=0.0.4; charset=utf-8";
  response.body = metrics.text();
  return response;
}

}  // namespace

void add_metrics_route(Router& router, const HubSite& site) {
  router.add(
      {"GET", "/metrics", Role::view, 0, [&site](const HttpRequest&) { return answer_metrics(site); }});
}

}  // namespace traygauge
