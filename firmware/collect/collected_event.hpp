// A scan or a correction as a hub publishes it.
#pragma once

#include <optional>
#include <string>

#include "firmware/broker/broker_link.hpp"

namespace traygauge {

struct CollectedEvent {
  std::string hub;       // the level of its topic, escaped as it is there
  std::string id;        // the same however often it comes
  std::string kind;      // "scan" or "correction"
  std::string station;   // that measured it; empty: it does not say
  std::string taken_at;  // UTC; empty: it does not say
  std::string body;      // JSON, as it came
};

// None where the message is no event of this prefix.
std::optional<CollectedEvent> read_event(const std::string& prefix, BrokerMessage message);

}  // namespace traygauge
