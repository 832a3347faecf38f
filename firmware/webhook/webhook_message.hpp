// What a webhook's receiver is told.
#pragma once

#include <optional>
#include <string>

#include "firmware/base/expected.hpp"
#include "firmware/store/open_store.hpp"

namespace traygauge {

struct WebhookMessage {
  std::string event_id;  // the same however often it is told; no other event has it
  std::string body;      // JSON
};

// The scan as it is now: what a message that waited says is never older than the one before it. None where
// the scan is gone.
Expected<std::optional<WebhookMessage>> webhook_message(Store& store, const PendingDelivery& delivery);

}  // namespace traygauge
