#include "firmware/handover/told_drift.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "firmware/handover/message.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

bool has_trend_keys(const Json& trend) {
  const auto is = [&trend](const char* key, bool (Json::*of_kind)() const noexcept) {
    const auto found = trend.find(key);
    return found != trend.end() && ((*found).*of_kind)();
  };
  return trend.is_object() && is("check", &Json::is_string) && is("median", &Json::is_number) &&
         is("sigma", &Json::is_number) && is("scans", &Json::is_number_unsigned) &&
         is("drift", &Json::is_string);
}

}  // namespace

std::string told_drift_json(const std::vector<ToldTrend>& trends) {
  Json json = {{"trends", Json::array()}};
  for (const ToldTrend& trend : trends) {
    json["trends"].push_back({{"check", trend.check},
                              {"median", trend.median},
                              {"sigma", trend.sigma},
                              {"scans", trend.scans},
                              {"drift", trend.drift}});
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Expected<std::vector<ToldTrend>> read_told_drift(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("trends") || !json["trends"].is_array())
    return Failure{"expected an object with a list of trends"};
  std::vector<ToldTrend> trends;
  for (const Json& trend : json["trends"]) {
    if (!has_trend_keys(trend))
      return Failure{"expected check, median, sigma, scans and drift of each trend"};
    trends.push_back({trend["check"].get<std::string>(), trend["median"].get<double>(),
                      trend["sigma"].get<double>(), trend["scans"].get<std::uint64_t>(),
                      trend["drift"].get<std::string>()});
  }
  return trends;
}

Expected<std::vector<ToldTrend>> ask_drift(const std::filesystem::path& socket, const std::string& station,
                                           Milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  Expected<LocalConnection> hub = connect_local(socket);
  if (!hub.ok()) return Failure{hub.failure()};
  const std::string question = encode({MessageType::ask_drift, Json{{"station", station}}.dump(), {}});
  if (const Expected<void> sent = hub->send_all(question, limit); !sent.ok()) return Failure{sent.failure()};
  MessageReader reader;
  for (;;) {
    const auto left = std::chrono::ceil<Milliseconds>(end - std::chrono::steady_clock::now());
    if (left <= Milliseconds::zero())
      return Failure{"the hub did not answer within " + std::to_string(limit.count()) + " ms"};
    const Expected<std::string> received = hub->receive_some(left);
    if (!received.ok()) return Failure{received.failure()};
    reader.append(*received);
    const Expected<std::optional<Message>> answer = reader.next();
    if (!answer.ok()) return Failure{answer.failure()};
    if (*answer && (*answer)->type == MessageType::drift) return read_told_drift((*answer)->text);
  }
}

}  // namespace traygauge
