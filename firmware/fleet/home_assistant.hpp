// Lets Home Assistant find the hub by itself, by its MQTT discovery.
#pragma once

#include <string>
#include <vector>

#include "firmware/fleet/fleet_config.hpp"

namespace traygauge {

struct RetainedMessage {
  std::string topic;
  std::string payload;
};

// Of one device with the hub's name: whether it is there, its health, the last tray's volume. Where
// home_assistant is false, the payloads are empty, by which Home Assistant forgets them.
std::vector<RetainedMessage> home_assistant_messages(const FleetConfig& config);

// Where Home Assistant says "online" when it starts; everything is sent again then.
std::string home_assistant_birth_topic(const FleetConfig& config);

}  // namespace traygauge
