// The table [fleet] of a station file: to which broker a hub tells its results.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "firmware/broker/broker_config.hpp"

namespace traygauge {

// When a result counts as delivered.
enum class FleetDelivery : std::uint8_t {
  receipt,  // a collector says that it has stored it
  broker,   // the broker has acknowledged it, which may keep it in memory alone
};

struct FleetConfig {
  BrokerConfig broker;
  std::string name;  // the hub's among those of the broker: station.name
  FleetDelivery delivery = FleetDelivery::receipt;
  std::optional<bool> home_assistant;  // whether it is told of this hub; false: it is told that it is gone
  std::string home_assistant_prefix = "homeassistant";
};

// `name` is the station's. Relative paths are relative to `folder`. Throws InputError.
FleetConfig read_fleet_table(const JsonNode& table, const std::string& name,
                             const std::filesystem::path& folder);

}  // namespace traygauge
