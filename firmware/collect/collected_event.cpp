#include "firmware/collect/collected_event.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "firmware/base/json_reading.hpp"
#include "firmware/broker/topic.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxIdBytes = 200;

}  // namespace

std::optional<CollectedEvent> read_event(const std::string& prefix, BrokerMessage message) {
  const auto parts = split_topic(prefix, message.topic);
  if (!parts || (parts->what != "scan" && parts->what != "correction")) return std::nullopt;
  // Deeper nesting is none of ours, and the parser would follow it.
  constexpr int kMaxDepth = 32;
  const nlohmann::json json = parse_shallow_json(message.payload, kMaxDepth);
  if (!json.is_object() || !json.contains("scan") || !json["scan"].is_object()) return std::nullopt;
  CollectedEvent event;
  event.hub = parts->level;
  event.id = json_text(json, "id");
  event.kind = json_text(json, "event");
  event.station = json_text(json["scan"], "station");
  event.taken_at = json_text(json["scan"], "taken_at");
  if (event.id.empty() || event.id.size() > kMaxIdBytes || event.kind != parts->what) return std::nullopt;
  event.body = std::move(message.payload);
  return event;
}

}  // namespace traygauge
