#include "firmware/collect/collected_event.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "firmware/broker/topic.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxIdBytes = 200;

std::string text_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

std::optional<CollectedEvent> read_event(const std::string& prefix, BrokerMessage message) {
  const auto parts = split_topic(prefix, message.topic);
  if (!parts || (parts->what != "scan" && parts->what != "correction")) return std::nullopt;
  // Deeper nesting is none of ours, and the parser would follow it.
  constexpr int kMaxDepth = 32;
  const auto is_shallow = [](int depth, Json::parse_event_t /*event*/, Json& /*parsed*/) {
    return depth <= kMaxDepth;
  };
  const Json json = Json::parse(message.payload, is_shallow, false);
  if (!json.is_object() || !json.contains("scan") || !json["scan"].is_object()) return std::nullopt;
  CollectedEvent event;
  event.hub = parts->level;
  event.id = text_of(json, "id");
  event.kind = text_of(json, "event");
  event.station = text_of(json["scan"], "station");
  event.taken_at = text_of(json["scan"], "taken_at");
  if (event.id.empty() || event.id.size() > kMaxIdBytes || event.kind != parts->what) return std::nullopt;
  event.body = std::move(message.payload);
  return event;
}

}  // namespace traygauge
