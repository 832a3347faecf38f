#include "firmware/webhook/webhook_message.hpp"

#include <nlohmann/json.hpp>

#include "firmware/api/scan_answer.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

// The time tells corrections apart that have the same number: one is lost where somebody puts an old copy of
// the store in its place, and the next one is another.
std::string event_id(const PendingDelivery& delivery) {
  std::string id = scan_id_text(delivery.id);
  if (delivery.correction > 0)
    id += ".correction-" + std::to_string(delivery.correction) + "." + std::to_string(delivery.correction_ms);
  return id;
}

}  // namespace

Expected<std::optional<WebhookMessage>> webhook_message(Store& store, const PendingDelivery& delivery) {
  const Expected<std::optional<StoredScan>> scan = store.scans().find(delivery.id);
  if (!scan.ok()) return Failure{scan.failure()};
  if (!*scan) return std::optional<WebhookMessage>();
  Expected<Json> answer = scan_answer(store, **scan);
  if (!answer.ok()) return Failure{answer.failure()};
  WebhookMessage message;
  message.event_id = event_id(delivery);
  const Json body = {{"event", delivery.correction > 0 ? "correction" : "scan"},
                     {"id", message.event_id},
                     {"scan", std::move(*answer)}};
  message.body = body.dump(-1, ' ', false, Json::error_handler_t::replace);
  return std::optional(std::move(message));
}

}  // namespace traygauge
