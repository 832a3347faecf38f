#include "firmware/api/health.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "firmware/api/scan_answer.hpp"
#include "firmware/base/json_reading.hpp"
#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// A station says something every two seconds; five such messages lost are a station that hangs.
constexpr std::chrono::seconds kSilentAfter{10};
// Raspberry Pis slow down from here on, by up to a half at 85 °C.
constexpr double kHotC = 80.0;
// A hub that was away takes what waits within seconds; what still stands then has another reason.
constexpr double kQueueStandsS = 60.0;
// No result was ever measured before this program was written: 2026-01-01.
constexpr std::int64_t kEarliestTimeMs = 1767225600000;

HealthPart examine_disk(const HubStore& store) {
  if (store.store() != nullptr) return {"disk", HealthState::ok, {}};
  return {"disk", HealthState::failing, store.problem()};
}

HealthPart examine_clock(const WallTime& now) {
  if (now.unix_ms < kEarliestTimeMs)
    return {"clock", HealthState::failing, "The clock says " + utc_text(now.unix_ms) + "; set it."};
  if (!now.synchronised)
    return {"clock", HealthState::warning,
            "Nothing synchronises the clock; times of scans may be wrong. Connect the hub to a time server."};
  return {"clock", HealthState::ok, {}};
}

// Of the board on which the station runs.
void examine_board(const std::string& station, const Json& state, std::vector<HealthPart>& parts) {
  const auto voltage = state.find("under_voltage");
  if (voltage != state.end() && *voltage == true) {
    parts.push_back({"power of " + station, HealthState::warning,
                     "The board's supply voltage is too low, or was since it started: take a stronger power "
                     "supply and a shorter, thicker cable, then switch it off and on."});
  }
  const auto temperature = state.find("temperature_c");
  if (temperature != state.end() && temperature->is_number() && temperature->get<double>() >= kHotC) {
    parts.push_back({"temperature of " + station, HealthState::warning,
                     "The board has " + fixed(temperature->get<double>(), 0) +
                         " °C and works slower from 80 °C on: let air come to it, or cool it."});
  }
}

void examine_queue(const std::string& station, const Json& state, std::vector<HealthPart>& parts) {
  const auto waiting = state.find("waiting_results");
  if (waiting == state.end() || !waiting->is_number_unsigned() || *waiting == 0) return;
  HealthPart queue{"queue of " + station, HealthState::warning,
                   waiting->dump() + " results wait at the station to be stored."};
  const auto stands = state.find("queue_stands_s");
  if (stands != state.end() && stands->is_number() && stands->get<double>() >= kQueueStandsS) {
    queue.state = HealthState::failing;
    queue.message += " None was taken for " + fixed(stands->get<double>(), 0) +
                     " s: look at the logs of hub and station for the reason.";
  }
  parts.push_back(queue);
}

// Of what the station said last; absent or strange parts say nothing.
void examine_state(const std::string& station, const Json& state, std::vector<HealthPart>& parts) {
  if (!state.is_object()) return;
  if (state.contains("faults") && state["faults"].is_array()) {
    for (const Json& fault : state["faults"]) {
      if (!fault.is_object()) continue;
      parts.push_back({json_text(fault, "device", "a device") + " of " + station, HealthState::failing,
                       json_text(fault, "message")});
    }
  }
  if (state.contains("disk") && state["disk"].is_string())
    parts.push_back({"disk of " + station, HealthState::failing, state["disk"].get<std::string>()});
  if (const std::string problem = json_text(state, "configuration"); !problem.empty())
    parts.push_back({"configuration of " + station, HealthState::warning, problem});
  if (const std::string dirt = json_text(state, "lens"); !dirt.empty())
    parts.push_back({"lens of " + station, HealthState::warning, dirt});
  examine_board(station, state, parts);
  examine_queue(station, state, parts);
}

void examine_station(const std::string& name, const LiveStation& live, std::vector<HealthPart>& parts) {
  const auto silent = std::chrono::steady_clock::now() - live.heard_at;
  const std::string seconds =
      std::to_string(std::chrono::duration_cast<std::chrono::seconds>(silent).count()) + " s";
  HealthPart station{"station " + name, HealthState::ok, {}};
  if (!live.is_connected) {
    station.state = HealthState::failing;
    station.message = "Station " + name + " went " + seconds + " ago; look whether it is switched on.";
  } else if (silent > kSilentAfter) {
    station.state = HealthState::failing;
    station.message = "Station " + name + " has said nothing for " + seconds + "; restart it.";
  }
  parts.push_back(station);
  if (station.state == HealthState::ok) examine_state(name, Json::parse(live.state, nullptr, false), parts);
}

HealthPart examine_webhook(const Webhook& webhook) {
  const WebhookState& state = webhook.state();
  if (!webhook.has_waited_long() && !state.is_refused) return {"webhook", HealthState::ok, {}};
  const Expected<std::int64_t> waiting = webhook.count_waiting();
  std::string text = waiting.ok() ? "Scans and corrections wait to be told: " + std::to_string(*waiting) + "."
                                  : waiting.failure();
  if (!state.last_failure.empty()) text += " " + state.last_failure;
  return {"webhook", HealthState::warning, text};
}

HealthPart examine_fleet(const Fleet& fleet) {
  const std::string trouble = fleet.trouble();
  return {"fleet", trouble.empty() ? HealthState::ok : HealthState::warning, trouble};
}

// Of stations that still measure; only what drifts is a part.
void examine_drift(const DriftWatch& drift, const WallTime& now, std::vector<HealthPart>& parts) {
  for (const StationTrends& station : drift.trends()) {
    if (!still_measures(station, now, drift.params())) continue;
    std::string message;
    for (const CheckTrend& trend : station.trends) {
      if (!trend.drifts) continue;
      if (!message.empty()) message += ' ';
      message += drift_sentence(trend);
    }
    if (!message.empty()) parts.push_back({"drift of " + station.station, HealthState::warning, message});
  }
}

HttpResponse answer_health(const HubSite& site) {
  const Health health = examine_health(site);
  return json_response(health_json(health), health.worst() == HealthState::failing ? 503 : 200);
}

}  // namespace

const char* name(HealthState state) {
  switch (state) {
    case HealthState::warning:
      return "warning";
    case HealthState::failing:
      return "failing";
    case HealthState::ok:
      break;
  }
  return "ok";
}

HealthState Health::worst() const {
  HealthState worst = HealthState::ok;
  for (const HealthPart& part : parts) worst = std::max(worst, part.state);
  return worst;
}

Health examine_health(const HealthSubjects& subjects) {
  Health health;
  health.parts.push_back(examine_disk(subjects.store));
  health.parts.push_back(examine_clock(subjects.now));
  if (!subjects.configuration_problem.empty())
    health.parts.push_back({"configuration", HealthState::warning, subjects.configuration_problem});
  if (subjects.webhook != nullptr) health.parts.push_back(examine_webhook(*subjects.webhook));
  if (subjects.fleet != nullptr) health.parts.push_back(examine_fleet(*subjects.fleet));
  for (const auto& [name, live] : subjects.inbox.stations()) examine_station(name, live, health.parts);
  examine_drift(subjects.drift, subjects.now, health.parts);
  return health;
}

Health examine_health(const HubSite& site) {
  return examine_health({site.store, site.inbox, site.drift, site.webhook, site.fleet,
                         site.facts.configuration_problem, site.wall_clock()});
}

std::string health_json(const Health& health) {
  Json json = {{"status", name(health.worst())}, {"parts", Json::array()}};
  for (const HealthPart& part : health.parts) {
    json["parts"].push_back({{"name", part.name},
                             {"status", name(part.state)},
                             {"message", part.message.empty() ? Json() : Json(part.message)}});
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void add_health_routes(Router& router, const HubSite& site) {
  // Without a token: who watches over a site has none, and the answer names no food and no person.
  router.add({"GET", "/health", Role::none, 0, [&site](const HttpRequest&) { return answer_health(site); }});
}

}  // namespace traygauge
