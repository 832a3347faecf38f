#include <nlohmann/json.hpp>

#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

HttpResponse stations(const StationInbox& inbox) {
  Json json = {{"stations", Json::array()}};
  const auto now = std::chrono::steady_clock::now();
  for (const auto& [name, live] : inbox.stations()) {
    const Json state = Json::parse(live.state, nullptr, false);
    json["stations"].push_back(
        {{"name", name},
         {"is_connected", live.is_connected},
         {"program", live.program},
         {"age_ms", std::chrono::duration_cast<std::chrono::milliseconds>(now - live.heard_at).count()},
         {"state", state.is_object() ? state : Json()}});
  }
  return json_answer(json);
}

}  // namespace

void add_station_routes(Router& router, const HubSite& site) {
  router.add({"GET", "/api/v1/stations", Role::view, 0,
              [&inbox = site.inbox](const HttpRequest&) { return stations(inbox); }});
  router.add({"GET", "/api/v1/events", Role::view, 0,
              [&events = site.events](const HttpRequest& request) { return events.open(request); }});
}

}  // namespace traygauge
