#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/api/hub_site.hpp"
#include "firmware/api/scan_answer.hpp"
#include "firmware/handover/next_tray.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxNextTrayBytes = 4096;
// From the till to the station, with a queue between.
constexpr int kDefaultValidS = 60;
constexpr int kLongestValidS = 3600;
constexpr int kMsPerS = 1000;

// The station that is named, or the only one.
Expected<std::string> choose_station(const Json& body, const StationInbox& inbox) {
  if (const auto named = body.find("station"); named != body.end()) {
    if (!named->is_string() || !inbox.stations().contains(named->get<std::string>()))
      return Failure{"station: expected the name of a station that this hub knows"};
    return named->get<std::string>();
  }
  if (inbox.stations().size() == 1) return inbox.stations().begin()->first;
  return Failure{"station: expected its name, because the hub has " +
                 std::to_string(inbox.stations().size())};
}

std::vector<std::string> dish_styles(const LiveStation& station) {
  const Json state = Json::parse(station.state, nullptr, false);
  std::vector<std::string> styles;
  if (!state.is_object() || !state.contains("dishes") || !state["dishes"].is_array()) return styles;
  for (const Json& style : state["dishes"]) {
    if (style.is_string()) styles.push_back(style.get<std::string>());
  }
  return styles;
}

Expected<ToldTray> read_body(const Json& body, const std::vector<std::string>& styles) {
  constexpr auto kKeys = std::to_array<std::string_view>({"station", "tray", "foods", "dishes", "valid_s"});
  Json told = {{"valid_ms", kDefaultValidS * kMsPerS}};
  for (const auto& [key, value] : body.items()) {
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end())
      return Failure{key + ": expected station, tray, foods, dishes or valid_s"};
    if (key == "valid_s") {
      if (!value.is_number_unsigned() || value < 1 || value > kLongestValidS)
        return Failure{"valid_s: expected a whole number from 1 to " + std::to_string(kLongestValidS)};
      told["valid_ms"] = value.get<int>() * kMsPerS;
    } else if (key != "station") {
      told[key] = value;
    }
  }
  if (!body.contains("tray") && !body.contains("foods") && !body.contains("dishes"))
    return Failure{"expected at least one of tray, foods and dishes"};
  return read_told_tray(told.dump(), styles);
}

// Its state, which shows what it knows of the next tray, follows.
HttpResponse tell(const HubSite& site, const std::string& station, const ToldTray& told, int status) {
  if (!site.inbox.tell(station, {MessageType::next_tray, told_tray_json(told), {}})) {
    std::string message = "Station " + station;
    message += " is not connected: nothing was told. Look whether it is switched on.";
    return error_response(409, "station_absent", message);
  }
  Json answer = {{"station", station}};
  answer.update(Json::parse(told_tray_json(told)));
  return json_answer(answer, status);
}

HttpResponse tell_next_tray(const HubSite& site, const HttpRequest& request) {
  const Json body = Json::parse(request.body, nullptr, false);
  if (!body.is_object()) return wrong_request("expected a JSON object, found something else");
  const Expected<std::string> station = choose_station(body, site.inbox);
  if (!station.ok()) return wrong_request(station.failure());
  const Expected<ToldTray> told = read_body(body, dish_styles(site.inbox.stations().at(*station)));
  if (!told.ok()) return wrong_request(told.failure());
  return tell(site, *station, *told, 202);
}

HttpResponse take_next_tray_back(const HubSite& site, const HttpRequest& request) {
  Json body = Json::object();
  if (const std::string* const station = request.parameter("station")) body["station"] = *station;
  const Expected<std::string> station = choose_station(body, site.inbox);
  if (!station.ok()) return wrong_request(station.failure());
  return tell(site, *station, {}, 202);
}

}  // namespace

void add_next_tray_routes(Router& router, const HubSite& site) {
  router.add({"POST", "/api/v1/next-tray", Role::manage, kMaxNextTrayBytes,
              [&site](const HttpRequest& request) { return tell_next_tray(site, request); }});
  router.add({"DELETE", "/api/v1/next-tray", Role::manage, 0,
              [&site](const HttpRequest& request) { return take_next_tray_back(site, request); }});
}

}  // namespace traygauge
